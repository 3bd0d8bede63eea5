#include "fpo/spectrum/spectrum_set.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sample_sets.h"

using fixtures::Points2;
using fpo::PlaneRegion;
using fpo::SpacingRule;
using fpo::SpectrumMass;
using fpo::SpectrumPoint;
using fpo::SpectrumSet;

namespace {

constexpr double hexagon = 0.86602540378443865;

double filled_area(const SpectrumSet& set) {
  double sum = 0;
  for (const SpectrumPoint& s : set.samples) sum += hexagon * s.spacing * s.spacing;
  return sum;
}

double total_mass(const std::vector<SpectrumMass>& pieces) {
  double sum = 0;
  for (const SpectrumMass& p : pieces) sum += p.mass;
  return sum;
}

}  // namespace

TEST_CASE("plane_set: hexagons fill the rectangle and pieces expect n samples, whatever the rule") {
  Points2 points = fixtures::random_in_square(200, 3);
  geom::Rng rng(4);
  for (auto& p : points) p.position.x() *= 2, p.weight = rng.uniform(0.5, 1.5);
  for (const SpacingRule rule : {SpacingRule::uniform, SpacingRule::weights, SpacingRule::local}) {
    for (const bool periodic : {true, false}) {
      const SpectrumSet set = fpo::plane_set(points, {.size = {2, 1}, .periodic = periodic}, rule, 3);
      CHECK(filled_area(set) == doctest::Approx(2));
      CHECK(set.copies.empty() == !periodic);
      if (rule == SpacingRule::uniform && periodic) {
        CHECK(set.background.empty());
        continue;
      }
      CHECK(total_mass(set.viewpoints) == doctest::Approx(200));
      double inside = 0;
      for (const SpectrumMass& b : set.background) {
        const auto& x = b.at.position;
        if (x.x() >= 0 && x.x() <= 2 && x.y() >= 0 && x.y() <= 1) inside += b.mass;
      }
      CHECK(inside == doctest::Approx(200));
      if (rule == SpacingRule::weights)
        for (std::size_t i = 1; i < points.size(); ++i)
          CHECK(std::pow(set.samples[i].spacing / set.samples[0].spacing, 2) ==
                doctest::Approx(points[i].weight / points[0].weight));
    }
  }
}

TEST_CASE("plane_set: copies are all that are near enough, each once; samples outside a torus come inside") {
  Points2 points = fixtures::random_in_square(60, 5);
  points[7].position += geom::Vec2(3, -2);
  const double radius = 4;
  const SpectrumSet set = fpo::plane_set(points, {}, SpacingRule::uniform, radius);
  const double margin = radius * set.samples[0].spacing;
  std::vector<std::array<double, 2>> found, expected;
  for (const SpectrumPoint& c : set.copies) found.push_back({c.position.x(), c.position.y()});
  for (const SpectrumPoint& s : set.samples) {
    REQUIRE((s.position.x() >= 0 && s.position.x() <= 1 && s.position.y() >= 0 && s.position.y() <= 1));
    for (int a = -3; a <= 3; ++a) {
      for (int b = -3; b <= 3; ++b) {
        const double x = s.position.x() + a, y = s.position.y() + b;
        const bool near = std::max({-x, x - 1, -y, y - 1}) <= margin;
        if (near && (a != 0 || b != 0)) expected.push_back({x, y});
      }
    }
  }
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  CHECK(found == expected);
}

TEST_CASE("plane_set: spacings by the local density follow the wanted ones") {
  const Points2 points = fixtures::plane_samples("waves5", 1500, 1, 10);
  const SpectrumSet wanted = fpo::plane_set(points, {}, SpacingRule::weights, 3);
  const SpectrumSet local = fpo::plane_set(points, {}, SpacingRule::local, 3);
  double off = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    off += std::abs(std::log(local.samples[i].spacing / wanted.samples[i].spacing));
  CHECK(off / 1500 < 0.06);
}

TEST_CASE("surface_set: samples get normals, hexagons fill the surface, pieces expect n samples") {
  const geom::TriMesh mesh = geom::make_shape("sphere", 10);
  const fpo::SpectrumSurface surface(mesh);
  const auto points = fixtures::random_on(mesh, 300, 1);
  for (const SpacingRule rule : {SpacingRule::uniform, SpacingRule::local}) {
    const SpectrumSet set = fpo::surface_set(points, surface, rule);
    CHECK(filled_area(set) == doctest::Approx(mesh.area()));
    CHECK(total_mass(set.viewpoints) == doctest::Approx(300));
    CHECK(total_mass(set.background) == doctest::Approx(300));
    CHECK(set.background.size() >= static_cast<std::size_t>(300 * fpo::background_density / 1.5));
    CHECK(set.copies.empty());
    for (std::size_t i = 0; i < points.size(); ++i)
      CHECK(set.samples[i].normal.dot(points[i].position.normalized()) > 0.999);
  }
}

TEST_CASE("rule_for: by weights as soon as two differ") {
  Points2 points = fixtures::random_in_square(3, 1);
  const auto rule = [&] { return fpo::rule_for(std::span<const geom::WeightedPoint2>(points)); };
  CHECK(rule() == SpacingRule::uniform);
  for (auto& p : points) p.weight = 0.1;
  CHECK(rule() == SpacingRule::uniform);
  points[2].weight = 0.2;
  CHECK(rule() == SpacingRule::weights);
}

TEST_CASE("plane_set, surface_set: what cannot be a set is refused") {
  Points2 points = fixtures::random_in_square(10, 1);
  const std::span<const geom::WeightedPoint2> all(points);
  const PlaneRegion torus, square{.size = {1, 1}, .periodic = false};
  CHECK_THROWS_AS(fpo::plane_set(all.first(1), torus, SpacingRule::uniform, 3), geom::InputError);
  CHECK_THROWS_AS(fpo::plane_set(all, torus, SpacingRule::weights, 3), geom::InputError);
  CHECK_THROWS_AS(fpo::plane_set(all, torus, SpacingRule::uniform, 1e5), geom::InputError);
  points[3].position.x() = 1.5;
  CHECK_THROWS_AS(fpo::plane_set(all, square, SpacingRule::uniform, 3), geom::InputError);
  for (auto& p : points) p.position = {0.5, 0.5};
  CHECK_THROWS_AS(fpo::plane_set(all, square, SpacingRule::local, 3), geom::InputError);
  const fpo::SpectrumSurface sphere(geom::make_shape("sphere", 3));
  CHECK_THROWS_AS(fpo::surface_set(fixtures::Points3(1), sphere, SpacingRule::uniform), geom::InputError);
}
