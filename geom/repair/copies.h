#pragma once
// Parts that lie a little beside another one: a body that is there twice, but for small differences.

#include "geom/mesh/trimesh.h"

namespace geom {

/// How near counts, in diagonals: less than any wall that is meant is thick, as a rule.
inline constexpr double usual_copy_distance = 3e-4;

/// Removes each part (facets joined by edges) all of whose vertices are at most `distance` from one other
/// part, and most of whose area faces as that one does: so the two sides of a thin wall stay. Of two that lie
/// on one another the larger stays, or else the first. Facets should agree in orientation (orient.h).
/// Returns the number of parts removed. O(F log F) for each pair of parts with nested boxes, and less where
/// they are not near; nothing is done if there are more than 2000 parts.
std::size_t drop_copies(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                        double distance);

}  // namespace geom
