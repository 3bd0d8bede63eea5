#pragma once
// Flips that make the smaller of two triangles' smallest angles larger: in the plane they lead to the
// Delaunay triangulation (Lawson 1977).

#include <functional>

#include "fpo/remesh/edited_mesh.h"

namespace fpo {

/// Degrees. The normal of a facet with a smaller angle says nothing.
inline constexpr double least_with_normal = 1e-6;

struct BetterFlips {
  std::function<bool(geom::VertexId, geom::VertexId)> is_allowed;  ///< an edge with a facet on each side
  double folded = 0.5;  ///< nothing where the cosine between the normals on both sides is less
};

/// Flips edges of the facets at v, and of those that change, as long as that makes the smallest angle on both
/// sides larger, and turns no facet over. For good. Ends, for each flip makes the sorted angles larger. How
/// many.
std::size_t make_better_flips(EditedMesh& mesh, geom::VertexId v, const BetterFlips& how);

/// At all edges.
std::size_t make_better_flips(EditedMesh& mesh, const BetterFlips& how);

}  // namespace fpo
