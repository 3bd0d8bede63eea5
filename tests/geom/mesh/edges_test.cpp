#include "geom/mesh/edges.h"

#include <set>

#include "doctest.h"
#include "tests/fixtures/hard_surfaces.h"

using namespace geom;

TEST_CASE("edges: each once, ascending, as a set of all sides of facets has them") {
  for (const auto& surface : fixtures::hard_surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    std::set<MeshEdge> expected;
    for (const TriMesh::Facet& f : mesh.facets())
      for (std::size_t e = 0; e < 3; ++e) expected.insert(mesh_edge(f[e], f[(e + 1) % 3]));
    CHECK(edges_of(mesh) == std::vector<MeshEdge>(expected.begin(), expected.end()));
  }
}
