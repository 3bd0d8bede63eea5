#pragma once
// Feature edges that the RRT lacks, made by flips, as constrained Delaunay triangulations are (Sloan 1993).
// Where curves are closer to each other than half an edge, a sample of one is in the ball about an edge of
// the other, and the RRT has the edge from that sample across the curve instead (facing_samples.h).

#include <cstddef>
#include <utility>

#include "fpo/features/feature_samples.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// `remesh` with as many of the chains' edges as up to six flips make each, and the number made. An edge of
/// a chain is flipped only if it is made again: where a sample has come to the wrong side of a curve. A flip
/// is not done where triangles would be folded back onto each other or have angles below one degree, so the
/// mesh stays of its topological type. The vertices stay. Deterministic. O(F log F), and some
/// hundred flips at most for an edge that is missing.
std::pair<geom::TriMesh, std::size_t> recover_edges(const geom::TriMesh& remesh,
                                                    const FeatureSamples& features);

/// The edges of the chains as vertices of a remesh, each with the smaller one first, ascending.
std::vector<std::pair<geom::VertexId, geom::VertexId>> chain_edges(const FeatureSamples& features);

}  // namespace fpo
