#pragma once
// The angles of a triangle.

#include <array>
#include <numbers>

#include "geom/mesh/angles.h"

namespace fpo {

/// In degrees (geom/mesh/angles.h).
inline std::array<double, 3> angles_of(const std::array<geom::Vec3, 3>& corners) {
  std::array<double, 3> angles;
  for (std::size_t i = 0; i < 3; ++i)
    angles[i] =
        180 / std::numbers::pi * geom::angle_at(corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
  return angles;
}

inline std::array<double, 3> angles_of(const geom::TriMesh& mesh, geom::FacetId t) {
  return angles_of({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
}

}  // namespace fpo
