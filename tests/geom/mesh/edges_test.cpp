#include "geom/mesh/edges.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

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

TEST_CASE("edges: visited by what is across, or by vertices, they come with all their half-edges") {
  const auto key = [](const HalfEdge& h) { return std::tuple(h.ends(), h.facet, h.edge, h.ascending); };
  for (const auto& surface : fixtures::hard_surfaces()) {
    CAPTURE(surface.name);
    using Edge = std::vector<decltype(key(HalfEdge{}))>;
    std::vector<Edge> expected, found;
    const auto collect = [&](std::vector<Edge>& edges) {
      return [&](auto first, auto last) {
        Edge edge;
        for (auto h = first; h != last; ++h) edge.push_back(key(*h));
        edges.push_back(edge);
      };
    };
    const TriMesh& mesh = surface.mesh;
    std::map<MeshEdge, Edge> all;
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      for (int e = 0; e < 3; ++e) {
        const HalfEdge h = half_edge(mesh.facets(), t, e);
        all[h.ends()].push_back(key(h));
      }
    for (const auto& [ends, edge] : all) expected.push_back(edge);
    for_each_edge(mesh.facets(), collect(found));
    CHECK(found == expected);  // in that order
    found.clear();
    for_each_edge(sorted_half_edges(mesh.facets()), collect(found));
    CHECK(found == expected);
    found.clear();
    for_each_edge(mesh, collect(found));
    std::ranges::sort(found);
    CHECK(found == expected);
  }
}
