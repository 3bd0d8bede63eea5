#include "fpo/spectrum/differential_histogram.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using fpo::DifferentialHistogram;
using geom::Vec2;

namespace {

struct Weighted {
  Vec2 d;
  double weight;
};

std::vector<Weighted> random_vectors(std::size_t count, double reach, std::uint64_t seed) {
  geom::Rng rng(seed);
  std::vector<Weighted> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back({{rng.uniform(-reach, reach), rng.uniform(-reach, reach)}, rng.uniform(-1, 1)});
  return all;
}

}  // namespace

TEST_CASE("DifferentialHistogram: every frequency against the sum itself, up to the aliasing it admits") {
  const double reach = 4, highest = 2.5, step = 0.125;
  const int half = 20;
  auto vectors = random_vectors(300, reach, 1);
  vectors.push_back({{reach, -reach}, 0.5});  // the farthest that is allowed
  vectors.push_back({{0, 0}, 1});
  DifferentialHistogram whole(reach, highest), first(reach, highest), second(reach, highest);
  double total = 0;
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    whole.add(vectors[k].d, vectors[k].weight);
    (k < 100 ? first : second).add(vectors[k].d, vectors[k].weight);
    total += vectors[k].weight * vectors[k].weight;
  }
  const auto power = whole.transform(step, half, 1);
  const auto at = [&](const std::vector<double>& p, int i, int j) {
    return p[static_cast<std::size_t>((j + half) * (2 * half + 1) + i + half)];
  };
  for (int j = -half; j <= half; ++j) {
    for (int i = -half; i <= half; ++i) {
      double sum = 0;
      for (const Weighted& v : vectors)
        sum += v.weight * std::cos(2 * std::numbers::pi * step * (i * v.d.x() + j * v.d.y()));
      // About 4e-4 of a sum of random phases for each of the nearest aliases.
      REQUIRE(std::abs(at(power, i, j) - sum) < 5e-3 * std::sqrt(total));
      REQUIRE(at(power, i, j) == at(power, -i, -j));
    }
  }
  first.merge(second);
  const auto merged = first.transform(step, half, 1);
  for (std::size_t k = 0; k < power.size(); ++k)
    REQUIRE(merged[k] == doctest::Approx(power[k]).scale(1).epsilon(1e-9));
  CHECK(whole.transform(step, half, 3) == power);
}

TEST_CASE("DifferentialHistogram: what does not fit") {
  CHECK_THROWS_AS(DifferentialHistogram(1e6, 3), geom::InputError);
  CHECK_THROWS_AS(DifferentialHistogram(0, 3), geom::InputError);
  CHECK_THROWS_AS(DifferentialHistogram(3, -1), geom::InputError);
  DifferentialHistogram h(3, 1);
  CHECK_THROWS_AS(h.add({3.1, 0}, 1), geom::Bug);
  CHECK_THROWS_AS(h.transform(0.1, 11, 1), geom::Bug);
  CHECK_THROWS_AS(h.merge(DifferentialHistogram(4, 1)), geom::Bug);
}
