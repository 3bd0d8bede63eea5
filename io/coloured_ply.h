#pragma once
// A mesh coloured by a positive quantity at its vertices, for viewers.

#include <filesystem>
#include <span>

#include "geom/mesh/trimesh.h"

namespace io {

/// Writes a binary PLY atomically (atomic_file.h) with vertex properties red, green, blue (blue: smallest
/// value, white: geometric mean of the extremes, red: largest; logarithmic) and value. One positive finite
/// value per vertex.
void write_coloured_ply(const std::filesystem::path& path, const geom::TriMesh& mesh,
                        std::span<const double> values);

}  // namespace io
