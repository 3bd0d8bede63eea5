#pragma once
// Border vertices that lie on border edges.

#include "geom/mesh/trimesh.h"

namespace geom {

/// Facets whose border edge passes within `tolerance` of border vertices, not near its ends, are cut there:
/// so the edge comes to have those vertices, and closes where their facets lie. Returns the number of cuts.
/// Where the vertices are not the edge's own but lie at the same places, welding has to follow. O(F log F) a
/// pass; a pass for each edge of a facet that is cut.
std::size_t zip_t_junctions(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                            double tolerance);

}  // namespace geom
