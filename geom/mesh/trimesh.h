#pragma once
// The input surface (paper, section 4): an immutable indexed triangle mesh with adjacency.

#include <array>
#include <string>
#include <vector>

#include "geom/shared_table.h"
#include "geom/vec.h"

namespace geom {

/// A triangle mesh. Facet corners are counterclockwise seen from outside; edge e of a facet joins corners e
/// and e+1 mod 3. Not necessarily manifold, closed or oriented: see topology(). Copies share the arrays.
class TriMesh {
 public:
  using Facet = std::array<VertexId, 3>;

  TriMesh() = default;
  /// Takes the arrays as they are. Throws InputError (one line, naming the vertex or facet) on an index out
  /// of range, a coordinate that is not finite, a facet that names a vertex twice, more than 2^30 elements.
  TriMesh(Table<VertexId, Vec3> vertices, Table<FacetId, Facet> facets);

  /// For each edge of a facet the facet across it, or none.
  using Across = Table<FacetId, std::array<FacetId, 3>>;
  /// A mesh of which adjacency and box are known: a part of another one (submesh.h). Checks nothing.
  TriMesh(Table<VertexId, Vec3> vertices, Table<FacetId, Facet> facets, Across across, const Box3& box)
      : vertices_(std::move(vertices)), facets_(std::move(facets)), across_(std::move(across)), box_(box) {}

  std::size_t num_vertices() const { return vertices_.size(); }
  std::size_t num_facets() const { return facets_.size(); }
  const Vec3& position(VertexId v) const { return vertices_[v]; }
  const Facet& facet(FacetId t) const { return facets_[t]; }
  const Vec3& corner(FacetId t, int i) const { return vertices_[facets_[t][static_cast<std::size_t>(i)]]; }
  /// A fourth coordinate (levels.h): 0 unless given.
  double level(VertexId v) const { return levels_.empty() ? 0 : levels_[v]; }
  bool has_levels() const { return !levels_.empty(); }
  const Table<VertexId, Vec3>& vertices() const& { return vertices_.table(); }
  const Table<FacetId, Facet>& facets() const& { return facets_.table(); }
  /// Of a mesh that ends with the expression: copies.
  Table<VertexId, Vec3> vertices() const&& { return vertices_.table(); }
  Table<FacetId, Facet> facets() const&& { return facets_.table(); }

  /// The facet across edge e of t, or none: border, or more than two facets at that edge.
  FacetId across(FacetId t, int e) const { return across_[t][static_cast<std::size_t>(e)]; }

  /// The same facets with vertices elsewhere, as many; all levels 0. Throws InputError on a coordinate that
  /// is not finite. O(V + F). The facets are shared.
  TriMesh with_vertices(Table<VertexId, Vec3> vertices) const;
  /// The same mesh with these levels, finite, one a vertex; none: all 0.
  TriMesh with_levels(Table<VertexId, double> levels) const;

  Vec3 normal(FacetId t) const;  ///< area-weighted: (q1 - q0) x (q2 - q0)
  double area(FacetId t) const { return 0.5 * normal(t).norm(); }
  double area() const;                      ///< sum over all facets
  const Box3& box() const { return box_; }  ///< of a part: of the whole
  double diagonal() const { return box_.isEmpty() ? 0 : box_.diagonal().norm(); }

 private:
  void check_vertices() const;
  void check_facets() const;
  void find_box();

  SharedTable<VertexId, Vec3> vertices_;
  SharedTable<VertexId, double> levels_;
  SharedTable<FacetId, Facet> facets_;
  SharedTable<FacetId, std::array<FacetId, 3>> across_;
  Box3 box_;
};

/// Counts that decide whether a mesh is a 2-manifold, and which.
struct Topology {
  std::size_t vertices = 0;  ///< referenced by a facet
  std::size_t edges = 0, facets = 0, components = 0, boundary_edges = 0, boundary_loops = 0;
  std::size_t nonmanifold_edges = 0;     ///< more than two facets
  std::size_t nonmanifold_vertices = 0;  ///< facets around it do not form one fan or one disk
  std::size_t misoriented_edges = 0;     ///< two facets that run through it the same way
  std::size_t unreferenced_vertices = 0;
  long euler = 0;  ///< V - E + F
  bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
};

/// Cost: O(F log F).
Topology topology(const TriMesh& mesh);

}  // namespace geom
