#pragma once
// The same surface with some edges cut, so that a feature may end within what was one edge.

#include <array>
#include <span>

#include "fpo/surface/split_facets.h"

namespace fpo {

struct EdgeCut {
  std::array<geom::VertexId, 2> edge;
  double share;  ///< of the edge, from its first end to the cut: above 0, below 1
};

/// Each cut is a new vertex, rounded to the exact range (geom/mesh/scaling.h), and the facets at the edge are
/// cut from there. Cuts of one edge in any order and direction; those at the same share are one. What is no
/// edge is passed over. The old vertices keep their ids; `h` is empty. O((F + cuts) log cuts), and
/// the cuts of an edge squared.
SplitSurface with_cut_edges(const geom::TriMesh& mesh, std::span<const EdgeCut> cuts);

/// A field that is linear on the facets of the mesh, at the vertices of the cut one as well. O(V + F).
VertexField on_cut_edges(const geom::TriMesh& mesh, const SplitSurface& cut, VertexField field);

}  // namespace fpo
