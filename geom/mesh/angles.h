#pragma once
// Angles between vectors, and of triangles, in radians: by the arc tangent of sine and cosine times lengths,
// which is accurate near 0 and pi, too.

#include <cmath>

#include "geom/mesh/trimesh.h"

namespace geom {

/// In [0, pi]; 0 if one vanishes.
inline double angle_between(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

/// At place a, between the ways to b and c.
inline double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) { return angle_between(b - a, c - a); }

/// Of the facet, at its corner i.
inline double corner_angle(const TriMesh& mesh, FacetId t, int i) {
  return angle_at(mesh.corner(t, i), mesh.corner(t, (i + 1) % 3), mesh.corner(t, (i + 2) % 3));
}

}  // namespace geom
