#include "fpo/spectrum/power_spectrum.h"

#include <cmath>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using fpo::PowerSpectrum;
using fpo::RadialCurve;

namespace {

/// P(f) = shape(|f|) times `noise()`, drawn once for each pair f, -f.
template <class Shape, class Noise>
PowerSpectrum spectrum_of(double step, int half, const Shape& shape, Noise noise) {
  PowerSpectrum s({step, step}, half, half);
  for (int j = 0; j <= half; ++j)
    for (int i = j == 0 ? 0 : -half; i <= half; ++i)
      s.at(i, j) = s.at(-i, -j) = shape(step * std::hypot(i, j)) * noise();
  return s;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

/// As the periodogram of independent samples has it.
struct Exponential {
  geom::Rng rng;
  double operator()() { return -std::log(1 - rng.uniform()); }
};

}  // namespace

TEST_CASE("radial_curve: of a power that is linear in |f| the curve is that line, without anisotropy") {
  const auto s = spectrum_of(
      0.05, 60, [](double f) { return 2 + 3 * f; }, [] { return 1.0; });
  const RadialCurve c = fpo::radial_curve(s, 0.1);
  REQUIRE(c.frequency.size() == 30);
  for (std::size_t k = 0; k < c.frequency.size(); ++k) {
    CHECK(c.frequency[k] == doctest::Approx(0.1 * static_cast<double>(k + 1)));
    // A ring's frequencies lie around its middle, not exactly there.
    CHECK(std::abs(c.mean[k] - (2 + 3 * c.frequency[k])) < 3 * 0.02);
    CHECK(c.anisotropy[k] < 1e-9);
  }
}

TEST_CASE("radial_curve: power that depends on the direction is anisotropic by its variance") {
  PowerSpectrum s({0.02, 0.02}, 100, 100);
  for (int j = -100; j <= 100; ++j)
    for (int i = -100; i <= 100; ++i) s.at(i, j) = 1 + 0.5 * std::cos(2 * std::atan2(j, i));
  const RadialCurve c = fpo::radial_curve(s, 0.1);
  for (std::size_t k = 4; k < c.frequency.size(); ++k) {
    CHECK(c.mean[k] == doctest::Approx(1).epsilon(0.01));
    CHECK(c.anisotropy[k] == doctest::Approx(0.125).epsilon(0.03));
  }
}

TEST_CASE("radial_curve: independent samples have anisotropy 0 dB, M averaged sets -10 log10 M") {
  std::vector<PowerSpectrum> sets;
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    sets.push_back(spectrum_of(
        0.02, 100, [](double) { return 1.0; }, Exponential{geom::Rng(seed)}));
  CHECK(std::abs(fpo::decibel(mean(fpo::radial_curve(sets[0], 0.1).anisotropy))) < 0.4);
  const PowerSpectrum average = fpo::mean_spectrum(sets);
  CHECK(average.smoothing == doctest::Approx(1));
  const RadialCurve c = fpo::radial_curve(average, 0.1);
  CHECK(std::abs(fpo::decibel(mean(c.anisotropy)) + fpo::decibel(8)) < 0.4);
  CHECK(mean(c.mean) == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("radial_curve: smoothing scales the anisotropy; rings with few frequencies have none") {
  auto s = spectrum_of(
      0.5, 4, [](double) { return 1.0; }, Exponential{geom::Rng(3)});
  const RadialCurve once = fpo::radial_curve(s, 0.25);
  s.smoothing = 7;
  const RadialCurve seven = fpo::radial_curve(s, 0.25);
  REQUIRE(once.frequency == seven.frequency);
  bool some_missing = false;
  for (std::size_t k = 0; k < once.frequency.size(); ++k) {
    some_missing |= std::isnan(once.anisotropy[k]);
    CHECK(std::isnan(once.anisotropy[k]) == std::isnan(seven.anisotropy[k]));
    if (!std::isnan(once.anisotropy[k]))
      CHECK(seven.anisotropy[k] == doctest::Approx(7 * once.anisotropy[k]));
  }
  CHECK(some_missing);
}

TEST_CASE("mean_spectrum: no spectra, and different grids") {
  CHECK_THROWS_AS(fpo::mean_spectrum({}), geom::InputError);
  const std::vector<PowerSpectrum> different{PowerSpectrum({1, 1}, 3, 3), PowerSpectrum({1, 1}, 3, 4)};
  CHECK_THROWS_AS(fpo::mean_spectrum(different), geom::Bug);
}
