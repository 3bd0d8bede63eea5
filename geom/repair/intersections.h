#pragma once
// Where a surface passes through itself.

#include "geom/mesh/trimesh.h"

namespace geom {

struct Intersections {
  std::size_t pairs =
      0;            ///< of facets that cross, or lie on one another, beyond the vertices and edges they share
  FacetId first;    ///< one of them, the least; or none
  bool all = true;  ///< false: there are too many facets near one another, and not all pairs were looked at
};

/// Pairs of facets whose interiors or edges pass through one another; exact. Coplanar facets that overlap are
/// not counted. `mesh`: in the unit box (scaling.h). O(F log F) where facets are of similar size; at worst
/// 1000 F pairs are tried.
Intersections self_intersections(const TriMesh& mesh);

}  // namespace geom
