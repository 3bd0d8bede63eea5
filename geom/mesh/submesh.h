#pragma once
// A part of a surface that is like the whole wherever it reaches.

#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Some facets of a mesh with their vertices. Ids ascend with those of the whole, adjacency and box are those
/// of the whole, so whatever breaks ties by ids or measures errors by the box decides alike in both.
struct Submesh {
  TriMesh mesh;
  std::vector<FacetId> facets;     ///< of the whole; ascending
  std::vector<VertexId> vertices;  ///< likewise

  /// The facet of the part, or none.
  FacetId here(FacetId of_whole) const;
};

/// `facets`: ascending, each once. O(F log F) of the part, or O(F) if that is no small part.
Submesh submesh(const TriMesh& whole, std::vector<FacetId> facets);

}  // namespace geom
