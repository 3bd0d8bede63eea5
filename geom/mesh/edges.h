#pragma once
// The edges of a mesh by their ends.

#include <algorithm>
#include <utility>
#include <vector>

#include "geom/mesh/half_edges.h"
#include "geom/mesh/trimesh.h"

namespace geom {

/// Ends ascending.
using MeshEdge = std::pair<VertexId, VertexId>;
inline MeshEdge mesh_edge(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

/// Each once, ascending: to be looked up by std::ranges::binary_search. O(F), as sorted_half_edges().
inline std::vector<MeshEdge> edges_of(const TriMesh& mesh) {
  std::vector<MeshEdge> edges;
  for_each_edge(sorted_half_edges(mesh.facets()), [&](auto first, auto) { edges.push_back(first->ends()); });
  return edges;
}

}  // namespace geom
