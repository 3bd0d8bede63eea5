#pragma once
// Holes found and closed.

#include "geom/repair/border_loops.h"

namespace geom {

/// Which borders are holes: those no longer than `length`, and those whose vector area is at most `area`. (A
/// surface that is meant to end has longer ones.)
struct HoleLimits {
  double length = 0;
  double area = 0;
};

struct HoleFilling {
  std::size_t filled = 0, facets = 0, vertices = 0;  ///< new ones
  std::size_t left = 0;                              ///< borders beyond the limits, or that no filling fits
  double longest_left = 0;
};

/// What --repair takes for holes: borders up to half a diagonal long, or of a vector area of at most 2
/// percent of the surface's.
HoleLimits usual_holes(double diagonal, double area);

bool is_hole(const BorderLoop& loop, const HoleLimits& limits);

/// Closes holes by the triangles that bend least (fill_polygon.h), refined to the size of the edges around
/// (patch.h). A filling adds no edge that is there already. Facets next to a hole should agree in orientation
/// (orient.h). Cost: that of those, and O(F log F).
HoleFilling fill_holes(Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                       const HoleLimits& limits);

}  // namespace geom
