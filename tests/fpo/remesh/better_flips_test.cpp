// Flips for better angles against the empty circles of the Delaunay triangulation.

#include "fpo/remesh/better_flips.h"

#include <algorithm>
#include <array>
#include <vector>

#include "doctest.h"
#include "fpo/remesh/facet_region.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// In the plane z = 0: more than 0 if d is in the circle of a, b, c, which are counterclockwise.
double in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = a - d, v = b - d, w = c - d;
  return u.squaredNorm() * (v.x() * w.y() - v.y() * w.x()) -
         v.squaredNorm() * (u.x() * w.y() - u.y() * w.x()) +
         w.squaredNorm() * (u.x() * v.y() - u.y() * v.x());
}

/// A square with vertices put in anywhere.
EditedMesh crowded_square(std::size_t n) {
  EditedMesh mesh(geom::make_shape("square", 1));
  geom::Rng rng(5);
  for (std::size_t k = 0; k < n; ++k) {
    const FacetId t(static_cast<std::size_t>(rng.uniform() * static_cast<double>(mesh.num_facets())));
    const double u = rng.uniform(), v = (1 - u) * rng.uniform();
    const auto& [a, b, c] = mesh.facet(t);
    mesh.split(t, mesh.position(a) + u * (mesh.position(b) - mesh.position(a)) +
                      v * (mesh.position(c) - mesh.position(a)));
  }
  return mesh;
}

}  // namespace

TEST_CASE("better flips: in the plane no circle holds a vertex then") {
  EditedMesh mesh = crowded_square(60);
  const std::size_t flips = make_better_flips(mesh, {[](VertexId, VertexId) { return true; }});
  CHECK(flips > 30);
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const auto& [a, b, c] = mesh.facet(t);
    REQUIRE(mesh.normal(t).z() > 0);
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
      if (v != a && v != b && v != c)
        CHECK(in_circle(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(v)) < 1e-9);
  }
  CHECK(make_better_flips(mesh, {[](VertexId, VertexId) { return true; }}) == 0);
}

TEST_CASE("better flips: what is not allowed stays, and so does an edge that the surface is folded at") {
  EditedMesh mesh = crowded_square(20);
  const TriMesh before = mesh.mesh();
  CHECK(make_better_flips(mesh, {[](VertexId, VertexId) { return false; }}) == 0);
  CHECK(mesh.mesh().facets() == before.facets());
  // Two needles at right angles to each other across their long edge.
  geom::Table<VertexId, Vec3> vertices;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 0.5, 0), Vec3(2, 0, 0.5)})
    vertices.push_back(p);
  geom::Table<FacetId, TriMesh::Facet> facets;
  facets.push_back({VertexId(0), VertexId(1), VertexId(2)});
  facets.push_back({VertexId(1), VertexId(0), VertexId(3)});
  EditedMesh folded{TriMesh(vertices, facets)};
  CHECK(make_better_flips(folded, {[](VertexId, VertexId) { return true; }}) == 0);
  CHECK(make_better_flips(folded, {[](VertexId, VertexId) { return true; }, -0.1}) == 1);
}
