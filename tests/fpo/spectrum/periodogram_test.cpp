#include "fpo/spectrum/periodogram.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "tests/fixtures/sample_sets.h"

using fpo::PowerSpectrum;
using geom::FlatTorus;
using geom::Vec2;

namespace {

std::vector<Vec2> random_on_torus(std::size_t n, const FlatTorus& torus, std::uint64_t seed) {
  std::vector<Vec2> x = fixtures::positions(fixtures::random_in_square(n, seed));
  for (Vec2& p : x) p = p.cwiseProduct(torus.period());
  return x;
}

double direct(const std::vector<Vec2>& samples, const FlatTorus& torus, int i, int j) {
  std::complex<double> sum = 0;
  for (const Vec2& p : samples)
    sum += std::polar(
        1.0, -2 * std::numbers::pi * (i * p.x() / torus.period().x() + j * p.y() / torus.period().y()));
  return std::norm(sum) / static_cast<double>(samples.size());
}

}  // namespace

TEST_CASE("periodogram: every frequency against the sum itself, on a long torus") {
  const FlatTorus torus({2, 0.75});
  for (const std::size_t n : {1u, 40u, 5000u}) {  // the last needs two blocks
    const auto x = random_on_torus(n, torus, n);
    const PowerSpectrum s = fpo::periodogram(x, torus, n == 5000 ? 0.2 : 2, 2);
    REQUIRE((s.half_x >= 3 || n == 1));
    for (int j = -s.half_y; j <= s.half_y; ++j)
      for (int i = -s.half_x; i <= s.half_x; ++i)
        REQUIRE(s.at(i, j) ==
                doctest::Approx(i == 0 && j == 0 ? 0 : direct(x, torus, i, j)).scale(1).epsilon(1e-9));
    // In units of 1 / r: the step along x is r / period.
    const double r = std::sqrt(2 / std::numbers::sqrt3 * torus.area() / static_cast<double>(n));
    CHECK(s.step.x() == doctest::Approx(r / torus.period().x()));
    CHECK(s.step.y() == doctest::Approx(r / torus.period().y()));
  }
}

TEST_CASE("periodogram: a lattice has all its power at the lattice's frequencies") {
  const fixtures::Lattice lattice(12, 14);
  const PowerSpectrum s =
      fpo::periodogram(fixtures::positions(lattice.points), FlatTorus(lattice.period), 2.5, 1);
  const auto n = static_cast<double>(lattice.points.size());
  int peaks = 0;
  for (int j = -s.half_y; j <= s.half_y; ++j) {
    for (int i = -s.half_x; i <= s.half_x; ++i) {
      const double f = std::hypot(i * s.step.x(), j * s.step.y()), p = s.at(i, j);
      if (p < 1e-9 * n || f > 2.5) continue;  // the grid is a square
      ++peaks;
      CHECK(p == doctest::Approx(n));
      CHECK(std::min({std::abs(f - 2 / std::sqrt(3)), std::abs(f - 2), std::abs(f - 4 / std::sqrt(3))}) <
            1e-9);
    }
  }
  CHECK(peaks == 18);
}

TEST_CASE("periodogram: any number of threads gives the same bytes; what cannot be is refused") {
  const FlatTorus torus({1, 1});
  const auto x = random_on_torus(300, torus, 5);
  const PowerSpectrum one = fpo::periodogram(x, torus, 3, 1);
  for (const int threads : {2, 3, 8}) CHECK(fpo::periodogram(x, torus, 3, threads).power == one.power);
  CHECK_THROWS_AS(fpo::periodogram({}, torus, 3, 1), geom::InputError);
  CHECK_THROWS_AS(fpo::periodogram(std::span(x).first(1), torus, 0.1, 1), geom::InputError);
  CHECK_THROWS_AS(fpo::periodogram(x, torus, 1e6, 1), geom::InputError);
}
