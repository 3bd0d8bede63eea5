// Outliers of scans.

#include "geom/repair/spikes.h"

#include "doctest.h"
#include "geom/repair/repair.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/needles.h"
#include "tests/fixtures/surfaces.h"

using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

TEST_CASE("spikes: shapes have none, not even at tips, and at towers that are many") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    CHECK(geom::spikes(mesh.vertices(), mesh.facets()).empty());
  }
  for (const TriMesh& mesh : {fixtures::fan(300, 40), fixtures::stretched_sphere(12, 10, 500),
                              fixtures::cylinder_of_needles(300), geom::make_shape("horn")})
    CHECK(geom::spikes(mesh.vertices(), mesh.facets()).empty());
  const TriMesh sphere = geom::make_shape("sphere", 8);
  geom::Table<VertexId, Vec3> towers = sphere.vertices();
  for (std::size_t i = 0; i < towers.size(); i += 15) towers[VertexId(i)] *= 4;
  CHECK(geom::spikes(towers, sphere.facets()).empty());
}

TEST_CASE("spikes: outliers go back to the surface, and nothing else moves") {
  const TriMesh sphere = geom::make_shape("sphere", 10);
  geom::Table<VertexId, Vec3> vertices = sphere.vertices();
  const std::vector<std::size_t> out{40, 217, 500, 777};
  double by = 3;
  for (const std::size_t i : out) vertices[VertexId(i)] *= by *= 10;
  // Two beside each other.
  const TriMesh::Facet beside = sphere.facet(geom::FacetId(900));
  vertices[beside[0]] *= 7, vertices[beside[1]] *= 9;
  const TriMesh spoilt(vertices, sphere.facets());
  CHECK(geom::spikes(vertices, sphere.facets()).size() > out.size());
  const geom::Repaired mended = geom::repaired(spoilt, geom::all_steps());
  REQUIRE(mended.lines.size() == 1);
  CHECK(mended.lines[0] == "flattened 6 spikes");
  REQUIRE(mended.mesh.facets() == sphere.facets());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double distance = (mended.mesh.vertices()[VertexId(i)] - sphere.vertices()[VertexId(i)]).norm();
    moved += distance > 1e-9;
    CHECK(distance < 0.1);
  }
  CHECK(moved == out.size() + 2);
}

TEST_CASE("spikes: vertices that were all folded to one place go back") {
  const TriMesh sphere = geom::make_shape("sphere", 10);
  geom::Table<VertexId, Vec3> vertices = sphere.vertices();
  const Vec3 place(0.3, 0.2, 0.9);
  std::size_t folded = 0, far = 0;
  for (std::size_t i = 5; i < vertices.size(); i += 25, ++folded) {
    far += (vertices[VertexId(i)] - place).norm() > 0.6;
    vertices[VertexId(i)] = place;
  }
  REQUIRE(far > folded / 2);
  CHECK(geom::spikes(vertices, sphere.facets()).size() >= far);
  geom::flatten_spikes(vertices, sphere.facets());
  std::size_t out = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    out += (vertices[VertexId(i)] - sphere.vertices()[VertexId(i)]).norm() > 0.6;
  CHECK(out == 0);
}
