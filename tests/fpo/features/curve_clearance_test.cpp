#include "fpo/features/curve_clearance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/block.h"

using namespace fpo;
using fixtures::block;
using geom::TriMesh;
using geom::Vec3;

namespace {

double nearest(const std::vector<CurveClearance>& places) {
  double least = 1e300;
  for (const CurveClearance& place : places) least = std::min(least, place.distance);
  return least;
}

}  // namespace

TEST_CASE(
    "curve clearance: edges of a block are as far apart as its least side, and none is nearer than that") {
  for (const double height : {1.0, 0.2, 0.001}) {
    CAPTURE(height);
    const TriMesh slab = block(1, 1, height);
    const Features features = find_features(slab);
    CHECK(curve_clearances(slab, features, 0.99 * height).empty());
    const std::vector<CurveClearance> places = curve_clearances(slab, features, 1.5 * height);
    CHECK(curve_clearances(slab, features, 1.5 * height, places.size()).size() == places.size());
    CHECK(curve_clearances(slab, features, 1.5 * height, 7).size() == 8);
    REQUIRE(!places.empty());
    CHECK(nearest(places) == doctest::Approx(height));
    double length = 0;
    for (const CurveClearance& place : places) {
      CHECK(place.length <= 0.2500001 * place.distance);
      CHECK(place.across);
      length += place.length;
    }
    CHECK(length >= 7.999);  // both rims
  }
}

TEST_CASE(
    "curve clearance: through the air is not across a strip, and places follow the mesh when it moves") {
  const TriMesh square = geom::make_shape("square");
  const TriMesh above = geom::mapped(square, [](const Vec3& p) -> Vec3 { return p + Vec3(0, 0, 0.05); });
  const TriMesh both = geom::joined(square, above);
  const std::vector<CurveClearance> places = curve_clearances(both, find_features(both), 0.1);
  REQUIRE(!places.empty());
  CHECK(nearest(places) == doctest::Approx(0.05));
  CHECK(std::ranges::none_of(places, [](const CurveClearance& place) { return place.across; }));
  const TriMesh larger = geom::mapped(both, [](const Vec3& p) -> Vec3 { return 4 * p; });
  const std::vector<CurveClearance> again = curve_clearances(larger, find_features(larger), 0.4);
  CHECK(again.size() == places.size());
  CHECK(nearest(again) == doctest::Approx(0.2));
}

TEST_CASE("curve clearance: a wedge's curves are beside each other at its corners, whose angles are told") {
  const TriMesh wedge = geom::make_shape("wedge");
  const Features features = find_features(wedge);
  const std::vector<CurveCorner> corners = curve_corners(wedge, features);
  double least = 10;
  for (const CurveCorner& corner : corners) {
    least = std::min(least, corner.angle);
    CHECK(corner.curve <= corner.other);
  }
  CHECK(180 / std::numbers::pi * least == doctest::Approx(15).epsilon(0.01));
  for (const CurveClearance& place : curve_clearances(wedge, features, 0.02))
    CHECK(place.distance > 0.019);  // near its corners curves come to nothing
  const TriMesh cube = geom::make_shape("cube");
  CHECK(curve_corners(cube, find_features(cube)).size() == 24);
}
