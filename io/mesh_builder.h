#pragma once
// Collects what a mesh file holds, checks it and makes the mesh.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "io/input_file.h"

namespace io {

/// Facets may name vertices that come later: their indices are checked and their polygons triangulated
/// (polygon.h) at the end. Errors name the place of the vertex or facet. Cost: linear (long non-convex
/// polygons: polygon.h).
class MeshBuilder {
 public:
  /// `unit` says what the places passed below count; `first_index` is the format's number of the first
  /// vertex.
  MeshBuilder(const InputFile& file, Unit unit, int first_index = 0)
      : file_(&file), unit_(unit), first_index_(first_index) {}

  /// Throws on a coordinate that is not finite or beyond 1e48.
  geom::VertexId add_vertex(const geom::Vec3& position, std::size_t place);
  /// A polygon by 0-based vertex indices. Fewer than three corners: a free-standing point or line, ignored.
  void add_facet(std::span<const std::int64_t> corners, std::size_t place);

  std::size_t num_vertices() const { return vertices_.size(); }
  const geom::Table<geom::VertexId, geom::Vec3>& vertices() const { return vertices_; }

  /// Throws if there is no facet or an index is out of range. A facet that names a vertex twice is refused,
  /// or, if `repeated` is given, loses that corner, and goes if it has not three others; how many such facets
  /// there were is added to it.
  geom::TriMesh finish(std::size_t* repeated = nullptr) &&;

 private:
  using Facets = geom::Table<geom::FacetId, geom::TriMesh::Facet>;

  struct Polygon {
    std::size_t first;  ///< in corners_; ends where the next polygon begins
    std::size_t place;
  };

  [[noreturn]] void fail(std::size_t place, std::string_view what) const {
    file_->fail({place, unit_}, what);
  }
  [[noreturn]] void fail_index(std::int64_t index, std::size_t place, std::string_view why) const;
  void check(std::span<const geom::VertexId> corners, std::size_t place) const;
  static geom::VertexId repeated_vertex(std::span<const geom::VertexId> corners);
  void append_triangles(std::span<const geom::VertexId> corners, Facets& facets) const;
  void append_the_rest(std::span<const geom::VertexId> corners, Facets& facets) const;

  const InputFile* file_;
  Unit unit_;
  int first_index_;
  geom::Table<geom::VertexId, geom::Vec3> vertices_;
  std::vector<geom::VertexId> corners_;
  std::vector<Polygon> polygons_;
};

}  // namespace io
