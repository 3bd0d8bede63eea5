#pragma once
// A mesh that is no manifold taken apart into sheets that are.

#include "geom/mesh/trimesh.h"

namespace geom {

struct Splitting {
  std::size_t edges = 0;     ///< that had more than two facets
  std::size_t vertices = 0;  ///< that have been added to tell sheets apart
};

/// Which facets around a vertex keep one vertex in common.
enum class Fans {
  keep_open,  ///< those that end at borders, so that holes that meet in a vertex can be filled one by one
  split       ///< only those joined by edges
};

/// At each edge of more than two facets these are paired, as many as there are: first those of one sheet
/// (joined elsewhere by edges of two facets), then those that agree in orientation, then those that bend
/// least, of which the whole seam between the same sheets decides; so the sheets have as few borders as can
/// be, and a fin keeps its own. Then each vertex whose facets are not joined around it becomes several at the
/// same place. Where two pairs at an edge share both ends even so, one gets a new vertex in the middle. With
/// Fans::split the result is a manifold. O(F log F) a round, few rounds. (Of more than 64 facets
/// at an edge, those next to each other are looked at only.)
Splitting split_sheets(Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets, Fans fans);

}  // namespace geom
