#pragma once
// The borders of a mesh, one after the other.

#include "geom/mesh/trimesh.h"

namespace geom {

struct BorderLoop {
  std::vector<VertexId> vertices;  ///< along the facets; none twice
  double length = 0;
  Vec3 vector_area{0, 0, 0};  ///< of a polygon through them
  bool simple = true;         ///< false: a chain that does not close (next to edges of more than two facets)
};

/// Edges with one facet, taken apart into simple cycles: where borders meet in a vertex each ends there. In
/// the order of their first edges. O(F log F).
std::vector<BorderLoop> border_loops(const Table<VertexId, Vec3>& vertices,
                                     const Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
