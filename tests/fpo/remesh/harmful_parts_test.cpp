#include "fpo/remesh/harmful_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "doctest.h"
#include "tests/fixtures/blade.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/triangles.h"

using namespace fpo;
using fixtures::Blade;
using fixtures::Triangle;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// A plate of 10 x 4 spacings, .3 thick: of each edge 10 long half is to be seen, for the opposite one is at
/// half of the width that is narrow.
TriMesh slab() { return fixtures::block(10, 4, 0.3); }

/// Across its side at y, .3 high and .8 long: an angle of 21 degrees, between two edges.
Triangle across_side(double x, double y) { return {Vec3(x, y, 0), Vec3(x + 0.8, y, 0), Vec3(x, y, 0.3)}; }

/// Beside its edge at y, z: less than 3 degrees, where no other edge is near.
Triangle beside_edge(double x, double y, double z) {
  return {Vec3(x, y, z), Vec3(x + 0.1, y, z), Vec3(x, 2, z)};
}

struct Question {
  std::size_t on_features = 1000;
  HarmOptions options{.spacing = 1};
};

std::vector<CreasePart> harmful_of(const TriMesh& surface, const std::vector<Triangle>& triangles,
                                   const Question& asked = {}) {
  const Features features = find_features(surface, automatic_features());
  return harmful_parts(surface, features, {fixtures::apart(triangles), asked.on_features}, asked.options);
}

std::vector<std::size_t> harmful(const TriMesh& surface, const std::vector<Triangle>& triangles,
                                 const Question& asked = {}) {
  std::vector<std::size_t> curves;
  for (const CreasePart& part : harmful_of(surface, triangles, asked)) curves.push_back(part.curve);
  return curves;
}

bool is_along(const TriMesh& surface, std::size_t curve, const Vec3& x) {
  const Features features = find_features(surface, automatic_features());
  const FeatureCurve& c = features.curves[curve];
  const Vec3 from = surface.position(c.vertices.front()), to = surface.position(c.vertices.back());
  return (x - from).cross(to - from).norm() < 1e-9 * (to - from).norm();
}

}  // namespace

TEST_CASE("harmful parts: one of two creases goes where triangles between are small enough or many") {
  const TriMesh surface = slab();
  CHECK(harmful(surface, {}).empty());
  CHECK(harmful(surface, {across_side(2, 0)}).empty());  // one such angle is not worth a long edge
  const std::vector<std::size_t> curves = harmful(surface, {across_side(2, 0), across_side(4, 0)});
  REQUIRE(curves.size() == 1);
  CHECK(is_along(surface, curves[0], {5, 0, 0}) != is_along(surface, curves[0], {5, 0, 0.3}));
  std::vector<Triangle> on_both;
  for (const double x : {2, 4})
    for (const double y : {0, 4}) on_both.push_back(across_side(x, y));
  const std::vector<std::size_t> both = harmful(surface, on_both);
  CHECK(both.size() == 2);
}

TEST_CASE("harmful parts: an angle that is hardly below 30 degrees is worth little") {
  const auto lacking = [](double degrees) {
    const double height = std::tan(degrees * std::numbers::pi / 180);
    return lacking_in_angles(fixtures::apart({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, height, 0)}}));
  };
  CHECK(lacking(30.1) == 0);
  CHECK(lacking(22.5) == doctest::Approx(0.25));
  CHECK(lacking(15) == doctest::Approx(0.5));
  CHECK(lacking(0) == 1);
  const Triangle hardly{Vec3(2, 0, 0), Vec3(2.53, 0, 0), Vec3(2, 0, 0.3)};  // 29.5
  CHECK(harmful(slab(), std::vector<Triangle>(20, hardly)).empty());
  CHECK(!harmful(slab(), std::vector<Triangle>(40, hardly)).empty());
}

TEST_CASE("harmful parts: angles of 30 degrees, beside one sample of a curve, or off the features do none") {
  const TriMesh surface = slab();
  const std::vector<Triangle> bad(20, across_side(2, 0));
  CHECK(harmful(surface, bad).size() == 1);
  CHECK(harmful(surface, bad, {.on_features = 0}).empty());
  const Triangle good{Vec3(2, 0, 0), Vec3(2.5, 0, 0), Vec3(2, 0, 0.3)};
  CHECK(harmful(surface, std::vector<Triangle>(20, good)).empty());
  const Triangle beside_one{Vec3(2, 0, 0), Vec3(3, 1, 0), Vec3(3, 1.1, 0)};
  CHECK(harmful(surface, std::vector<Triangle>(20, beside_one)).empty());
}

TEST_CASE("harmful parts: creases are not given up if that takes most of what there is") {
  const TriMesh surface = slab();
  const std::vector<Triangle> one(20, beside_edge(2, 0, 0));
  REQUIRE(harmful(surface, one).size() == 1);
  CHECK(is_along(surface, harmful(surface, one)[0], {5, 0, 0}));
  std::vector<Triangle> three = one;
  for (const Vec3& at : {Vec3(2, 0, 0.3), Vec3(2, 4, 0)})
    three.insert(three.end(), 20, beside_edge(at.x(), at.y(), at.z()));
  CHECK(harmful(surface, three).size() == 2);  // three are more than half of all
}

TEST_CASE("harmful parts: of two creases that meet at a small angle one ends earlier") {
  const Blade blade;
  const std::vector<CreasePart> parts = harmful_of(blade.mesh, {blade.tip()});
  REQUIRE(parts.size() == 1);
  CHECK(!parts[0].is_whole);
  CHECK(parts[0].lacking == doctest::Approx(lacking_in_angles(fixtures::apart({blade.tip()}))));
  double far = 0;
  for (const FeatureEdge& edge : parts[0].edges)
    for (const geom::VertexId v : edge) far = std::max(far, blade.mesh.position(v).norm());
  // To where it is .7 spacings from the other, and not farther than the edge that goes on there.
  CHECK(far >= 0.7 / std::sin(blade.angle));
  CHECK(far < 0.7 / std::sin(blade.angle) + 2 * blade.edge);
}

TEST_CASE("harmful parts: another one where one is spared, none where all are, none of straight long edges") {
  const Blade blade;
  HarmOptions options{.spacing = 1};
  std::vector<FeatureEdge> spared;
  std::vector<std::size_t> blamed;
  for (int time = 0; time < 2; ++time) {
    options.spared = spared;
    const std::vector<CreasePart> parts = harmful_of(blade.mesh, {blade.tip()}, {.options = options});
    REQUIRE(parts.size() == 1);
    blamed.push_back(parts[0].curve);
    spared.push_back(parts[0].edges.front());
  }
  CHECK(blamed[0] != blamed[1]);
  options.spared = spared;
  CHECK(harmful(blade.mesh, {blade.tip()}, {.options = options}).empty());
  const Blade whole(1);
  CHECK(harmful(whole.mesh, {whole.tip()}).empty());
}

TEST_CASE("harmful parts: a fault is as bad as an angle of nothing between the creases that are near") {
  const TriMesh surface = slab();
  const Features features = find_features(surface, automatic_features());
  const TriMesh good = fixtures::apart({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0.8, 0)}});
  const auto at = [&](const Vec3& fault) {
    return harmful_parts(surface, features, {good, 3, {&fault, 1}}, {.spacing = 1});
  };
  const std::vector<CreasePart> parts = at(Vec3(5, 0, 0.15));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].lacking == 1);
  CHECK(is_along(surface, parts[0].curve, {5, 0, 0}) != is_along(surface, parts[0].curve, {5, 0, 0.3}));
  CHECK(at(Vec3(5, 2, 0)).empty());  // no crease is near
}

TEST_CASE("harmful parts: borders stay, whatever is beside them") {
  const TriMesh open = geom::make_shape("wave-disk");
  const Features features = find_features(open, automatic_features());
  REQUIRE(!features.curves.empty());
  const FeatureCurve& border = features.curves[0];
  const Vec3 a = open.position(border.vertices[0]), b = open.position(border.vertices[1]);
  const std::vector<Triangle> bad(20, Triangle{a, b, a + 100 * (b - a).cross(Vec3::UnitZ())});
  CHECK(harmful(open, bad).empty());
}
