#pragma once
// From the vertices of a surface as it is remeshed to those of the file that it was read from.

#include <vector>

#include "geom/mesh/trimesh.h"

namespace tools {

/// Of each vertex of a mesh the first vertex of the file at the same place, to the bit. Cleaning keeps places;
/// a repair may make vertices that the file has not: for these none. O(V log V).
geom::Table<geom::VertexId, geom::VertexId> own_vertices(const geom::TriMesh& mesh,
                                                         const geom::Table<geom::VertexId, geom::Vec3>& file);

}  // namespace tools
