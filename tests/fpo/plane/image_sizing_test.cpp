#include "fpo/plane/image_sizing.h"

#include <cmath>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using geom::FlatTorus;
using geom::Vec2;

TEST_CASE("image sizing: dark is dense, the top row is at the top, the seam is no edge") {
  const FlatTorus torus({4, 2});
  fpo::DensityImage image{8, 4, std::vector<float>(32, 0.25f)};
  image.density[8 + 2] = 1;  // second row from the top, third column
  const auto sizing = fpo::image_sizing(image, torus, 100, {.floor = 0.01, .gradation = 100});
  CHECK(sizing->rho({2.5 * 0.5, 2 - 1.5 * 0.5}) == doctest::Approx(1));
  CHECK(sizing->rho({6.5 * 0.5, 2 - 1.5 * 0.5}) == doctest::Approx(2));
  geom::Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const double x = rng.uniform(0, 4), y = rng.uniform(0, 2);
    CHECK(sizing->rho({0, y}) == doctest::Approx(sizing->rho({4, y})));
    CHECK(sizing->rho({x, 0}) == doctest::Approx(sizing->rho({x, 2})));
  }
}

TEST_CASE("image sizing: the wanted edge length keeps to the gradation, and only decreases") {
  const FlatTorus torus({1, 1});
  fpo::DensityImage image{40, 40, std::vector<float>(1600)};
  geom::Rng rng(2);
  for (float& d : image.density) d = rng.below(20) == 0 ? 1.f : 0.f;
  const std::size_t n = 1000;
  const double gradation = 0.2;
  const auto sizing = fpo::image_sizing(image, torus, n, {.floor = 0.01, .gradation = gradation});
  const double scale = fpo::PlaneDensity(*sizing, torus).edge_length_scale(n);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 x(rng.uniform(), rng.uniform()), y(rng.uniform(), rng.uniform());
    // Steps of the grid's eight directions are up to 8% longer than the straight way; the scale that the
    // limit was computed with converges to the one of the limited field.
    const double most = 1.1 * gradation * torus.shortest(y - x).norm();
    CHECK(scale * std::abs(sizing->rho(y) - sizing->rho(x)) <= most);
    CHECK(sizing->rho(x) <= 10);
    CHECK(sizing->rho(x) >= 1);
  }
}

TEST_CASE("image sizing: an image of one value is refused") {
  for (const float value : {0.f, 0.5f, 1.f}) {
    const fpo::DensityImage image{4, 4, std::vector<float>(16, value)};
    CHECK_THROWS_AS(fpo::image_sizing(image, FlatTorus({1, 1}), 100), geom::InputError);
  }
  CHECK_THROWS_AS(fpo::image_sizing({}, FlatTorus({1, 1}), 100), geom::InputError);
}
