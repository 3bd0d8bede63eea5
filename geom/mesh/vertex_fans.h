#pragma once
// The facets around a vertex, followed from each to the next across their common edge.

#include <cstdint>

#include "geom/mesh/trimesh.h"

namespace geom {

/// Nothing is sorted: eight bytes a vertex are all that it keeps.
class VertexFans {
 public:
  /// Keeps a reference. O(F).
  explicit VertexFans(const TriMesh& mesh);

  std::size_t num_facets(VertexId v) const { return num_facets_[v]; }
  struct Fan {
    /// All facets of the vertex follow each other across edges of two facets: then no edge at it has more,
    /// for each of three facets there would begin or end a fan, which has only two ends.
    bool is_whole;
    bool is_doubled;  ///< two that follow each other have the same vertices
  };
  /// The one of a vertex that has a facet. O(facets of v).
  Fan at(VertexId v) const;
  /// Do the facets of v form one fan or one disk? True if it has none.
  bool is_manifold(VertexId v) const { return num_facets_[v] == 0 || at(v).is_whole; }

 private:
  /// Where a walk around a vertex is, and which edge is crossed next: that to `over`.
  struct Step {
    FacetId facet;
    VertexId over;
  };
  Step next(VertexId v, const Step& step) const;

  const TriMesh& mesh_;
  Table<VertexId, std::uint32_t> num_facets_;
  Table<VertexId, FacetId> facet_of_;
};

}  // namespace geom
