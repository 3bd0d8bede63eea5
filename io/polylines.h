#pragma once
// Polylines in the plane in a text file.

#include <filesystem>
#include <vector>

#include "geom/vec.h"

namespace io {

/// Lines "x y"; consecutive ones are joined, a blank line (or one with a comment only, '#') starts a new
/// polyline, a line by itself is a point. Throws geom::InputError "path:line: what", also if there is no
/// point.
std::vector<std::vector<geom::Vec2>> read_polylines(const std::filesystem::path& path);

}  // namespace io
