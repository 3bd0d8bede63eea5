#pragma once
// The topological type of a surface, part by part.

#include <compare>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Of a connected compact 2-manifold these three are its type (classification of surfaces).
struct PartType {
  long euler = 0;
  std::size_t border_loops = 0;
  bool orientable = true;
  auto operator<=>(const PartType&) const = default;
};

/// Parts are facets joined by edges, in the order of their first facets. Where a mesh is no manifold the
/// numbers are those of its facets, edges and vertices as they are, and edges of more than two facets are
/// left out of the question which side is left.
struct SurfaceType {
  std::vector<PartType> parts;
  Table<FacetId, std::size_t> part_of;
  bool manifold = true;
};

/// O(F log F). `topology`: of the mesh, where it is known.
SurfaceType surface_type(const TriMesh& mesh, const Topology& topology);
inline SurfaceType surface_type(const TriMesh& mesh) { return surface_type(mesh, topology(mesh)); }

}  // namespace geom
