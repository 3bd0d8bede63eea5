#pragma once
// The edges of a mesh by their ends.

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "geom/mesh/half_edges.h"
#include "geom/mesh/trimesh.h"

namespace geom {

/// Calls visit(first, last) for the half-edges of each edge, in order of facets; the edges in no order that
/// means anything. O(F), and the edges that have not two facets sorted: where nearly all have, less than
/// sorted_half_edges().
template <class Visit>
void for_each_edge(const TriMesh& mesh, Visit visit) {
  const Table<FacetId, TriMesh::Facet>& facets = mesh.facets();
  std::vector<HalfEdge> others;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const HalfEdge here = half_edge(facets, t, e);
      const FacetId across = mesh.across(t, e);
      if (!across.valid()) {
        others.push_back(here);
      } else if (t < across) {
        std::array<HalfEdge, 2> both{here, half_edge(facets, across, 0)};
        for (int i = 1; both[1].ends() != here.ends(); ++i) both[1] = half_edge(facets, across, i);
        visit(both.begin(), both.end());
      }
    }
  std::ranges::sort(others, {}, [](const HalfEdge& h) { return std::tuple(h.low, h.high, h.facet); });
  for_each_edge(others, visit);
}

/// Ends ascending.
using MeshEdge = std::pair<VertexId, VertexId>;
inline MeshEdge mesh_edge(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Each once, ascending: to be looked up by std::ranges::binary_search. O(F), as sorted_half_edges().
inline std::vector<MeshEdge> edges_of(const TriMesh& mesh) {
  std::vector<MeshEdge> edges;
  for_each_edge(mesh.facets(), [&](auto first, auto) { edges.push_back(first->ends()); });
  return edges;
}

}  // namespace geom
