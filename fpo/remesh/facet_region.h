#pragma once
// The facets around a place of an edited mesh, and their angles.

#include <array>
#include <vector>

#include "fpo/remesh/edited_mesh.h"

namespace fpo {

/// Ascending.
using FacetRegion = std::vector<geom::FacetId>;

/// In degrees.
std::array<double, 3> angles_of(const EditedMesh& mesh, geom::FacetId t);
double least_angle(const EditedMesh& mesh, geom::FacetId t);

/// The facets at these vertices.
FacetRegion region_of(const EditedMesh& mesh, const std::vector<geom::VertexId>& vertices);
/// The vertices of the facets, ascending.
std::vector<geom::VertexId> vertices_of(const EditedMesh& mesh, const FacetRegion& region);

}  // namespace fpo
