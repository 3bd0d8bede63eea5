#pragma once
// Polygons in space, in groups, as OBJ.

#include <filesystem>
#include <string>
#include <vector>

#include "geom/vec.h"

namespace io {

struct GroupedPolygon {
  std::int64_t group;
  std::vector<geom::Vec3> corners;
};

/// Writes "g PREFIX<group>" before each run of polygons of one group, then v and f lines, atomically. Throws
/// geom::InputError "cannot write path: reason".
void write_polygons(const std::filesystem::path& path, const std::string& prefix,
                    const std::vector<GroupedPolygon>& polygons);

}  // namespace io
