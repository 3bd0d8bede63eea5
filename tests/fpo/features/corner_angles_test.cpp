// The smallest angle between features, on shapes where it is known.

#include "fpo/features/corner_angles.h"

#include <numbers>

#include "doctest.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

double of(const TriMesh& mesh) { return corner_angles(mesh, find_features(mesh)).smallest; }
std::size_t sharp(const TriMesh& mesh) { return corner_angles(mesh, find_features(mesh)).below_30; }

}  // namespace

TEST_CASE("corner angles: a cube's are right, a wedge has its own, a sphere none") {
  CHECK(of(geom::make_shape("cube")) == doctest::Approx(90));
  CHECK(of(geom::make_shape("wedge")) == doctest::Approx(15));
  CHECK(of(geom::make_shape("sphere")) == 180);
  CHECK(sharp(geom::make_shape("cube")) == 0);
  CHECK(sharp(geom::make_shape("wedge")) == 2);  // on its two ends
  CHECK(sharp(geom::make_shape("star")) == 10);
}

TEST_CASE("corner angles: those of several facets are added up, the way around a border is none") {
  // A fan of four facets of 25 degrees about the origin: its two border edges there are at 100 degrees.
  geom::Table<VertexId, Vec3> vertices;
  vertices.push_back(Vec3(0, 0, 0));
  for (int k = 0; k <= 4; ++k) {
    const double angle = 25 * k * std::numbers::pi / 180;
    vertices.push_back(Vec3(std::cos(angle), std::sin(angle), 0));
  }
  geom::Table<FacetId, TriMesh::Facet> facets;
  for (std::size_t k = 1; k <= 4; ++k) facets.push_back({VertexId(0), VertexId(k), VertexId(k + 1)});
  const TriMesh fan(vertices, facets);
  CHECK(of(fan) == doctest::Approx(77.5));  // at the ends of the arc
  CHECK(sharp(fan) == 0);
  CHECK(of(TriMesh(vertices, {facets[FacetId(0)]})) == doctest::Approx(25));
  CHECK(sharp(TriMesh(vertices, {facets[FacetId(0)]})) == 1);
}
