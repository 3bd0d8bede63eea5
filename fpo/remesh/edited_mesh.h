#pragma once
// A mesh whose edges are flipped and whose vertices are moved, on trial: these can be undone. Facets and
// edges are split and edges collapsed for good.

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
  std::size_t num_facets() const { return facets_.size(); }  ///< those that collapsed as well
  const geom::Vec3& position(VertexId v) const { return positions_[v]; }
  const Facet& facet(FacetId t) const { return facets_[t]; }
  /// Ascending.
  const std::vector<FacetId>& facets_at(VertexId v) const { return at_[v]; }
  geom::Vec3 normal(FacetId t) const;  ///< area-weighted

  bool has_edge(VertexId a, VertexId b) const;
  /// Of a vertex, ascending.
  std::vector<VertexId> neighbours(VertexId v) const;
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

  /// These are for good: nothing before is taken back any more. A new vertex in the facet, which stays at the
  /// edge from its first corner to the second; two facets are new.
  VertexId split(FacetId t, const geom::Vec3& at);
  /// On an edge: one new facet, at b, for each of the facets there, in their order.
  VertexId split(VertexId a, VertexId b, const geom::Vec3& at);
  /// Does the mesh stay of its topological type if v becomes w, which it is joined to? The link condition:
  /// the two have no neighbours in common but those in the facets at their edge (Dey, Edelsbrunner, Guha,
  /// Nekhayev, Topology preserving edge contraction, 1999). O(degrees).
  bool can_collapse(VertexId v, VertexId w) const;
  /// Takes v into w; the facets at their edge are no more. Requires can_collapse().
  void collapse(VertexId v, VertexId w);
  bool has_facet(FacetId t) const { return facets_[t][0].valid(); }
  /// Forgets how edits are taken back.
  void keep() { edits_.clear(); }

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
  bool has_twin_facet(VertexId v, VertexId w, const std::vector<VertexId>& thirds) const;
  void set(FacetId t, const Facet& facet);
  FacetId add(const Facet& facet);

  geom::Table<VertexId, geom::Vec3> positions_;
  geom::Table<FacetId, Facet> facets_;
  geom::Table<VertexId, std::vector<FacetId>> at_;
  std::vector<Edit> edits_;
};

}  // namespace fpo
