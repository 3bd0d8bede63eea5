#include "fpo/remesh/harmful_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/block.h"
#include "tests/fixtures/triangles.h"

using namespace fpo;
using fixtures::Triangle;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// A plate of 10 x 4 spacings, .3 thick: of each edge 10 long half is to be seen, for the opposite one is at
/// half of the width that is narrow.
TriMesh plate() { return fixtures::block(10, 4, 0.3); }

/// Across its side at y, .3 high and 1 long: an angle of 17 degrees, between two edges.
Triangle across_side(double x, double y) { return {Vec3(x, y, 0), Vec3(x + 1, y, 0), Vec3(x, y, 0.3)}; }

/// Beside its edge at y, z: less than 3 degrees, where no other edge is near.
Triangle beside_edge(double x, double y, double z) {
  return {Vec3(x, y, z), Vec3(x + 0.1, y, z), Vec3(x, 2, z)};
}

std::vector<std::size_t> harmful(const TriMesh& surface, const std::vector<Triangle>& triangles,
                                 std::size_t on_features = 1000, double spacing = 1) {
  const Features features = find_features(surface, automatic_features());
  return harmful_curves(surface, features, {fixtures::apart(triangles), on_features}, spacing);
}

bool is_along(const TriMesh& surface, std::size_t curve, const Vec3& x) {
  const Features features = find_features(surface, automatic_features());
  const FeatureCurve& c = features.curves[curve];
  const Vec3 from = surface.position(c.vertices.front()), to = surface.position(c.vertices.back());
  return (x - from).cross(to - from).norm() < 1e-9 * (to - from).norm();
}

}  // namespace

TEST_CASE("harmful curves: one of two creases goes where triangles between are small enough or many") {
  const TriMesh surface = plate();
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

TEST_CASE("harmful curves: an angle that is hardly below 30 degrees is worth nothing") {
  const auto lacking = [](double degrees) {
    const double height = std::tan(degrees * std::numbers::pi / 180);
    return lacking_in_angles(fixtures::apart({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, height, 0)}}));
  };
  CHECK(lacking(28.1) == 0);
  CHECK(lacking(21) == doctest::Approx(0.25));
  CHECK(lacking(14) == doctest::Approx(0.5));
  CHECK(lacking(0) == 1);
  const Triangle hardly{Vec3(2, 0, 0), Vec3(2.55, 0, 0), Vec3(2, 0, 0.3)};
  CHECK(harmful(plate(), std::vector<Triangle>(20, hardly)).empty());
}

TEST_CASE("harmful curves: angles of 30 degrees, beside one sample of a curve, or off the features do none") {
  const TriMesh surface = plate();
  const std::vector<Triangle> bad(20, across_side(2, 0));
  CHECK(harmful(surface, bad).size() == 1);
  CHECK(harmful(surface, bad, 0).empty());
  const Triangle good{Vec3(2, 0, 0), Vec3(2.5, 0, 0), Vec3(2, 0, 0.3)};
  CHECK(harmful(surface, std::vector<Triangle>(20, good)).empty());
  const Triangle beside_one{Vec3(2, 0, 0), Vec3(3, 1, 0), Vec3(3, 1.1, 0)};
  CHECK(harmful(surface, std::vector<Triangle>(20, beside_one)).empty());
}

TEST_CASE("harmful curves: corners of the input stay, and creases are not given up if that takes most") {
  const TriMesh wedge = geom::make_shape("wedge");
  const Features features = find_features(wedge, automatic_features());
  std::vector<Triangle> corners;  // of samples on two curves that meet there
  const auto other_end = [](const FeatureCurve& curve, geom::VertexId end) {
    return end == curve.vertices.front() ? curve.vertices.back() : curve.vertices.front();
  };
  for (const geom::VertexId tip : features.corners)
    for (const FeatureCurve& a : features.curves)
      for (const FeatureCurve& b : features.curves) {
        const bool meet = &a < &b && std::ranges::find(a.vertices, tip) != a.vertices.end() &&
                          std::ranges::find(b.vertices, tip) != b.vertices.end();
        if (!meet) continue;
        const Vec3 x = wedge.position(tip), p = wedge.position(other_end(a, tip)),
                   q = wedge.position(other_end(b, tip));
        corners.push_back({x, x + (p - x).normalized() / 10, x + (q - x).normalized() / 10});
      }
  REQUIRE(lacking_in_angles(fixtures::apart(corners)) > 0.9);  // two of 15 degrees
  std::vector<Triangle> many;
  for (int i = 0; i < 20; ++i) many.insert(many.end(), corners.begin(), corners.end());
  CHECK(harmful(wedge, many, 3 * many.size(), 0.1).empty());

  const TriMesh surface = plate();
  const std::vector<Triangle> one(20, beside_edge(2, 0, 0));
  REQUIRE(harmful(surface, one).size() == 1);
  CHECK(is_along(surface, harmful(surface, one)[0], {5, 0, 0}));
  std::vector<Triangle> three = one;
  for (const Vec3& at : {Vec3(2, 0, 0.3), Vec3(2, 4, 0)})
    three.insert(three.end(), 20, beside_edge(at.x(), at.y(), at.z()));
  CHECK(harmful(surface, three).size() == 2);  // three are more than half of all
}

TEST_CASE("harmful curves: borders stay, whatever is beside them") {
  const TriMesh open = geom::make_shape("wave-disk");
  const Features features = find_features(open, automatic_features());
  REQUIRE(!features.curves.empty());
  const FeatureCurve& border = features.curves[0];
  const Vec3 a = open.position(border.vertices[0]), b = open.position(border.vertices[1]);
  const std::vector<Triangle> bad(20, Triangle{a, b, a + 100 * (b - a).cross(Vec3::UnitZ())});
  CHECK(harmful(open, bad).empty());
}
