#pragma once
// The angles of a triangle.

#include <array>
#include <cmath>
#include <numbers>

#include "geom/mesh/trimesh.h"

namespace fpo {

/// In degrees, by the arc tangent of sine and cosine times lengths: accurate near 0 and 180 degrees too.
inline std::array<double, 3> angles_of(const std::array<geom::Vec3, 3>& corners) {
  std::array<double, 3> angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const geom::Vec3 u = corners[(i + 1) % 3] - corners[i], v = corners[(i + 2) % 3] - corners[i];
    angles[i] = 180 / std::numbers::pi * std::atan2(u.cross(v).norm(), u.dot(v));
  }
  return angles;
}

inline std::array<double, 3> angles_of(const geom::TriMesh& mesh, geom::FacetId t) {
  return angles_of({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
}

}  // namespace fpo
