#pragma once
// The filling of a hole made like its surroundings.

#include <span>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Facets from `first` on fill a hole whose rim consists of the vertices that they share with the facets
/// before (`beside`: all of those that have one of its vertices, ascending). Where they are larger than the
/// rim's edges they are cut, vertex by vertex, and edges flipped so that angles are large (Liepa 2003); then
/// the new vertices are moved so that the patch bends as evenly as its surroundings (uniform bi-Laplacian, by
/// sparse least squares). The rest of the mesh stays. Returns the number of new vertices. O(p log p) for p
/// facets in and beside it, and some O(k^1.5) for k new vertices.
std::size_t refine_patch(Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                         FacetId first, std::span<const FacetId> beside);

}  // namespace geom
