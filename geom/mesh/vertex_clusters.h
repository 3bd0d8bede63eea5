#pragma once
// A coarse version of a dense mesh, for pictures: vertices in one cell of a grid become one.

#include "geom/mesh/trimesh.h"

namespace geom {

/// The mean of the vertices in each cell of a grid of cubes of that width (measured from the box's corner)
/// stands for them; facets whose corners fall together are left out, and so are repetitions of the same
/// three. The result need not be a manifold. Its vertices are in the order in which the mesh first names the
/// cells. O(F log F).
TriMesh clustered(const TriMesh& mesh, double width);

/// The mesh itself if it has at most `most` facets, else clustered() by a width for which that is so: about
/// the least of them. `width`: that one, 0 if none was needed.
TriMesh with_fewer_facets(const TriMesh& mesh, std::size_t most, double* width = nullptr);

}  // namespace geom
