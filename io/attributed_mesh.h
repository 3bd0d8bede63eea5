#pragma once
// Meshes and points with what their vertices carry, as PLY and OBJ.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "io/ply.h"

namespace io {

struct AttributedMesh {
  const geom::Table<geom::VertexId, geom::Vec3>& vertices;
  std::span<const geom::TriMesh::Facet> facets;  ///< none: points
  std::span<const VertexProperty> properties;    ///< a value per vertex each
  std::span<const geom::Vec2> texture = {};
  /// Of each facet the texture coordinates of its corners; empty: none.
  std::span<const std::array<std::int32_t, 3>> corner_texture = {};
};

/// Binary, little-endian; the properties in their types (integers rounded, cut to the range of the type),
/// texture coordinates as the list `texcoord` of each face.
std::string to_ply(const AttributedMesh& mesh);
/// Of the properties red, green and blue, after the coordinates, from 0 to 1.
std::string to_obj(const AttributedMesh& mesh);

}  // namespace io
