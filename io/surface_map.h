#pragma once
// Where the vertices of a remesh lie on the input, for the transfer of attributes: a line per vertex with the
// facet, counted from 1, and the barycentric coordinates of the vertex in it.

#include <filesystem>
#include <span>

#include "geom/mesh/trimesh.h"

namespace io {

/// A place in a facet: sum of barycentric[i] times corner i.
struct MappedPoint {
  geom::FacetId facet;
  geom::Vec3 barycentric;
};

/// Writes atomically (atomic_file.h); every bit is kept. Throws geom::InputError "cannot write path: reason".
void write_surface_map(const std::filesystem::path& path, std::span<const MappedPoint> points);

}  // namespace io
