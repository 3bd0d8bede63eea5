#pragma once
// Facets turned so that neighbours agree which side is outside.

#include "geom/mesh/trimesh.h"

namespace geom {

struct Orientation {
  std::size_t turned = 0;             ///< facets
  std::size_t inverted = 0;           ///< facets that were turned otherwise than most of their part
  std::size_t parts_turned = 0;       ///< closed parts that were inside out
  std::size_t one_sided = 0;          ///< parts that cannot be oriented (a Moebius band)
  std::size_t parts_left_inside = 0;  ///< closed parts that face inwards inside the box of another: cavities
};

/// In each part (facets joined by edges of two facets) the fewer facets are turned over. A closed part then
/// faces outwards (its volume is positive), unless all its facets faced inwards and its box lies inside that
/// of another closed part: a cavity. O(F log F + parts^2).
Orientation orient(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
