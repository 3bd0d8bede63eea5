#pragma once
// Where the vertices of a remesh lie on the input, for the transfer of attributes: a line per vertex with
// three vertices of the input, counted from 1, and their weights.

#include <array>
#include <filesystem>
#include <span>

#include "geom/mesh/trimesh.h"

namespace io {

/// A place in a triangle: the sum of barycentric[i] times vertex i.
struct MappedPoint {
  std::array<geom::VertexId, 3> vertices;
  geom::Vec3 barycentric;
};

/// Writes atomically (atomic_file.h); every bit is kept. Throws geom::InputError "cannot write path: reason".
void write_surface_map(const std::filesystem::path& path, std::span<const MappedPoint> points);

}  // namespace io
