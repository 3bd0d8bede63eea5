#pragma once
// Polygons of mesh files cut into triangles.

#include <array>
#include <span>
#include <vector>

#include "geom/vec.h"

namespace io {

/// Triangles over corner numbers 0 .. n-1, n - 2 of them, each turning like the polygon. Ear clipping in the
/// coordinate plane most nearly parallel to the polygon, with exact turns: right for every simple polygon,
/// convex or not, whose projection there is simple; for others (bow-ties, zero area) still n - 2 triangles
/// that use each polygon edge once. Cost O(n + n r), r the number of corners that are not convex.
std::vector<std::array<int, 3>> triangulate(std::span<const geom::Vec3> polygon);

}  // namespace io
