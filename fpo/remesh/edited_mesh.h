#pragma once
// A mesh whose edges are flipped and whose vertices are moved, on trial: all can be undone.

#include <vector>

#include "geom/mesh/trimesh.h"

namespace fpo {

class EditedMesh {
 public:
  using VertexId = geom::VertexId;
  using FacetId = geom::FacetId;
  using Facet = geom::TriMesh::Facet;

  explicit EditedMesh(const geom::TriMesh& mesh);

  std::size_t num_vertices() const { return positions_.size(); }
  std::size_t num_facets() const { return facets_.size(); }
  const geom::Vec3& position(VertexId v) const { return positions_[v]; }
  const Facet& facet(FacetId t) const { return facets_[t]; }
  /// Ascending.
  const std::vector<FacetId>& facets_at(VertexId v) const { return at_[v]; }
  geom::Vec3 normal(FacetId t) const;  ///< area-weighted

  bool has_edge(VertexId a, VertexId b) const;
  /// The facet that runs from a to b. None if there is none, or more than one.
  FacetId beside(VertexId a, VertexId b) const;
  /// The corner of a facet that is neither a nor b.
  VertexId third(FacetId t, VertexId a, VertexId b) const;
  /// Is a vertex of a facet with an edge that has no facet on the other side, or more than one?
  bool is_on_border(VertexId v) const;

  /// Has the edge one facet on each side, and are their third corners not joined yet? Then the mesh stays of
  /// its topological type.
  bool can_flip(VertexId a, VertexId b) const;
  /// Joins the third corners of both facets at the edge instead. Requires can_flip(). O(degree).
  void flip(VertexId a, VertexId b);
  void move(VertexId v, const geom::Vec3& to);

  std::size_t num_edits() const { return edits_.size(); }
  /// Takes back all but the first edits.
  void undo_to(std::size_t num_edits);

  /// Its facets begin with their smallest vertex and are sorted, as those of extract().
  geom::TriMesh mesh() const;

 private:
  /// A facet, or a vertex, as it was.
  struct Edit {
    FacetId t;
    Facet facet;
    VertexId v;
    geom::Vec3 at;
  };
  void set(FacetId t, const Facet& facet);

  geom::Table<VertexId, geom::Vec3> positions_;
  geom::Table<FacetId, Facet> facets_;
  geom::Table<VertexId, std::vector<FacetId>> at_;
  std::vector<Edit> edits_;
};

}  // namespace fpo
