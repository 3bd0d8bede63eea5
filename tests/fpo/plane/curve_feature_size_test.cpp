// Feature sizes of curves whose medial axis is known, and the sizing made of them.

#include "fpo/plane/curve_feature_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using fpo::CurvePoint;
using fpo::Polyline;
using geom::FlatTorus;
using geom::Vec2;

namespace {

Polyline circle(const Vec2& center, double radius, int corners) {
  Polyline curve;
  for (int k = 0; k <= corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k % corners) / corners;
    curve.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return curve;
}

}  // namespace

TEST_CASE("curve feature size: of a circle its radius, wherever it lies, also across the seam") {
  const FlatTorus torus({1, 1});
  for (const Vec2& center : {Vec2(0.5, 0.5), Vec2(0.02, 0.97), Vec2(-0.3, 1.2)}) {
    // A polygon of 120 corners means a circle: the branches into its corners are left out.
    const std::vector<Polyline> curves = {circle(center, 0.2, 120)};
    const auto points = fpo::curve_feature_size(curves, torus, 0.002);
    REQUIRE(points.size() > 600);
    for (const CurvePoint& c : points) {
      CHECK(c.feature_size == doctest::Approx(0.2).epsilon(0.01));
      CHECK(torus.shortest(c.position - torus.snap(center)).norm() == doctest::Approx(0.2).epsilon(0.001));
    }
  }
}

TEST_CASE("curve feature size: half the distance of parallel lines, of concentric circles at the inner one") {
  const FlatTorus torus({2, 1});
  const std::vector<Polyline> lines = {{{0, 0.25}, {2, 0.25}}, {{0, 0.55}, {2, 0.55}}};
  for (const CurvePoint& c : fpo::curve_feature_size(lines, torus, 0.01))
    CHECK(c.feature_size == doctest::Approx(0.15).epsilon(1e-3));
  const std::vector<Polyline> rings = {circle({0.5, 0.5}, 0.2, 400), circle({0.5, 0.5}, 0.3, 400)};
  for (const CurvePoint& c : fpo::curve_feature_size(rings, torus, 0.002))
    CHECK(c.feature_size == doctest::Approx(0.05).epsilon(0.02));
}

TEST_CASE("curve feature size: of isolated points half the distance to the nearest other") {
  for (const Vec2& period : {Vec2(1, 1), Vec2(3, 1), Vec2(1, 9)}) {
    const FlatTorus torus(period);
    geom::Rng rng(3);
    std::vector<Polyline> points;
    for (int i = 0; i < 40; ++i)
      points.push_back({Vec2(rng.uniform(0, period.x()), rng.uniform(0, period.y()))});
    for (const CurvePoint& c : fpo::curve_feature_size(points, torus, 0.01)) {
      double least = period.minCoeff();  // its own copies
      for (const Polyline& other : points) {
        const double distance = torus.shortest(other[0] - c.position).norm();
        if (distance > 1e-9) least = std::min(least, distance);
      }
      CHECK(c.feature_size == doctest::Approx(least / 2));
    }
  }
  const std::vector<Polyline> alone = {{Vec2(0.3, 0.9)}};
  CHECK(fpo::curve_feature_size(alone, FlatTorus({2, 1}), 0.01).at(0).feature_size == doctest::Approx(0.5));
}

TEST_CASE(
    "curve feature size: at a sharp corner it falls to the spacing, and grows by the distance at most") {
  const FlatTorus torus({1, 1});
  const std::vector<Polyline> square = {{{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}, {0.3, 0.3}}};
  const double spacing = 0.005;
  const auto points = fpo::curve_feature_size(square, torus, spacing);
  for (const CurvePoint& c : points) {
    const Vec2 from_center = (c.position - Vec2(0.5, 0.5)).cwiseAbs();
    const double to_corner = 0.2 - from_center.minCoeff();
    // The diagonals inside: as far as the corner is along the side, but at most 0.2; outside none nearer.
    CHECK(std::abs(c.feature_size - std::max(to_corner / std::numbers::sqrt2, 0.0)) < 1.5 * spacing);
  }
}

TEST_CASE("feature sizing: the limits hold, and rho is the feature size on the curve where they allow") {
  const FlatTorus torus({1, 1});
  const std::vector<Polyline> curves = {circle({0.3, 0.5}, 0.03, 200), circle({0.7, 0.5}, 0.15, 400)};
  const auto points = fpo::curve_feature_size(curves, torus, 0.001);
  const std::size_t n = 4000;
  const auto sizing = fpo::feature_sizing(points, torus, n, {.ratio = 3, .gradation = 0.3});
  const double scale = fpo::PlaneDensity(*sizing, torus).edge_length_scale(n);
  double least = INFINITY, most = 0;
  geom::Rng rng(5);
  for (int k = 0; k < 20000; ++k) {
    const Vec2 x(rng.uniform(), rng.uniform()), y = torus.snap(x + 0.01 * Vec2(rng.uniform(), rng.uniform()));
    const double change = std::abs(sizing->rho(x) - sizing->rho(y)) * scale;
    CHECK(change <= 1.1 * 0.3 * torus.shortest(x - y).norm() + 1e-12);  // 1.1: steps along the grid
    least = std::min(least, sizing->rho(x));
    most = std::max(most, sizing->rho(x));
  }
  CHECK(most <= 3.01 * least);
  for (const CurvePoint& c : points)
    if (c.feature_size > 0.14)
      CHECK(sizing->rho(c.position) <= 1.05 * c.feature_size);
    else
      CHECK(sizing->rho(c.position) >= 0.149 / 3);
}

TEST_CASE("curve feature size: nothing, nonsense and endless curves are refused") {
  using geom::InputError;
  const FlatTorus torus({1, 1});
  const auto of = [&](std::vector<Polyline> curves, double spacing = 0.01) {
    return fpo::curve_feature_size(curves, torus, spacing);
  };
  CHECK_THROWS_AS(of({}), InputError);
  CHECK_THROWS_AS(of({{}}), InputError);
  CHECK_THROWS_AS(of({{{0.5, NAN}}}), InputError);
  CHECK_THROWS_AS(of({{{0, 0}, {1e9, 0}}}), InputError);
  CHECK_THROWS_AS(of({{{0, 0}, {1, 0}}}, 0), InputError);
  CHECK_THROWS_AS(fpo::feature_sizing({}, torus, 100), InputError);
}
