#pragma once
// Point sets in files.

#include <filesystem>
#include <vector>

#include "geom/vec.h"

namespace io {

/// .xyz: x y z [weight] a line; .txt: x y [weight] a line; .ply: vertices with an optional property "weight".
enum class PointFormat { xyz, txt, ply };

/// The format that a file name's extension means, in any case. Throws geom::InputError on another extension.
PointFormat point_format(const std::filesystem::path& path);

/// Reads points in space from .xyz or .ply. In .xyz '#' starts a comment, and every line has three or four
/// numbers. Without weights they are 0. Throws geom::InputError "path:line: what" as read_mesh does, also if
/// there is no point. Cost: linear.
std::vector<geom::WeightedPoint3> read_points3(const std::filesystem::path& path);
/// Reads points in the plane from .txt, likewise.
std::vector<geom::WeightedPoint2> read_points2(const std::filesystem::path& path);

/// Writes .xyz or .ply atomically (atomic_file.h); every bit is kept. Weights are written if one of them is
/// not 0. Throws geom::InputError "cannot write path: reason".
void write_points(const std::filesystem::path& path, const std::vector<geom::WeightedPoint3>& points);
/// Writes .txt likewise.
void write_points(const std::filesystem::path& path, const std::vector<geom::WeightedPoint2>& points);

}  // namespace io
