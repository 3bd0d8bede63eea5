#pragma once
// What mesh files say beside the surface: numbers at vertices, texture coordinates, groups and lines.

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "geom/mesh/trimesh.h"
#include "io/ply.h"

namespace io {

/// A triangle of the file's facets, polygons triangulated as read_mesh() does.
struct AttributedTriangle {
  geom::TriMesh::Facet vertices;
  std::array<std::int32_t, 3> texture;  ///< of its corners: numbers of texture coordinates, -1: none
  std::int32_t part;                    ///< the same for the same group, object and material
};

/// Vertices have the ids that the file gives them. Whatever the file has not is empty.
struct Attributes {
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  std::vector<VertexProperty> properties;          ///< in OBJ the colour: red, green, blue, from 0 to 1
  std::vector<geom::Vec2> texture;                 ///< OBJ: vt; PLY: texcoord of faces
  std::vector<AttributedTriangle> triangles;       ///< if it has texture coordinates or several parts
  std::vector<std::vector<geom::VertexId>> lines;  ///< OBJ: l
  bool parts = false;                              ///< whether triangles have different parts
  bool dropped = false;                            ///< PLY: whether faces have numbers that are not read
};

/// Of a file that read_mesh() takes: OBJ and PLY; from others nothing but the vertices. Throws as that does.
/// Linear.
Attributes read_attributes(const std::filesystem::path& path);

}  // namespace io
