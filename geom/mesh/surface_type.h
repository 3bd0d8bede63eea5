#pragma once
// The topological type of a surface, part by part.

#include <compare>
#include <cstdint>
#include <vector>

#include "geom/disjoint_sets.h"
#include "geom/mesh/trimesh.h"

namespace geom {

/// Of a connected compact 2-manifold these three are its type (classification of surfaces).
struct PartType {
  long euler = 0;
  std::size_t border_loops = 0;
  bool orientable = true;
  auto operator<=>(const PartType&) const = default;
};

/// Parts are facets joined by edges, in the order of their first facets. A vertex counts once for each of its
/// sheets, the facets about it that are joined by edges at it: a surface that meets itself in vertices only
/// is of the type of the manifold that it is when these are split. Edges of more than two facets count as
/// they are, and are left out of the question which side is left.
struct SurfaceType {
  std::vector<PartType> parts;
  Table<FacetId, std::uint32_t> part_of;
  bool branches = false;           ///< an edge has more than two facets
  std::size_t split_vertices = 0;  ///< those of several sheets

  PartType whole() const;  ///< the sums; orientable if all parts are
};

/// Of corner i of facet t, at 3 t + i: the corners joined to it by edges at their common vertex are one set.
DisjointSets sheets_at_vertices(const TriMesh& mesh);

/// O(F).
SurfaceType surface_type(const TriMesh& mesh);

/// The types of what is left if the surface is cut along all edges of more than two facets, ascending. O(F).
std::vector<PartType> pieces_between_branches(const TriMesh& mesh);

}  // namespace geom
