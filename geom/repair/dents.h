#pragma once
// Facets that are missing at a border.

#include "geom/mesh/trimesh.h"

namespace geom {

/// How large a dent may be: `facets`, its sides less two, and a share of the surface's area.
struct DentLimits {
  std::size_t facets = 4;
  double area = 1e-3;
};

/// Fills dents: stretches of a border that leave it and come back to it, deep beside their width, where the
/// border would go straight on without them (by 40 degrees at both ends). So teeth that follow one another
/// stay, and all dents do if together they are more than 2 percent of the area. No vertex is added and no
/// edge that is there already. Facets there should agree in orientation. Returns the number of dents. O(F
/// log F).
std::size_t fill_dents(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                       const DentLimits& limits);

}  // namespace geom
