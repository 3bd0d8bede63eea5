#pragma once
// A body far from the origin is computed near it: there filters decide what takes exact arithmetic out there.

#include "geom/mesh/trimesh.h"

namespace geom {

/// What to subtract from a body so that it lies around the origin: on each axis on which its middle is more
/// than eight diagonals away that middle, else 0. There all coordinates lie within a factor of 2 of it, so
/// the subtraction is exact. 0 also where what is left would be too small for scaling.h.
Vec3 far_middle(const TriMesh& mesh);

/// The mesh with `by` added to every vertex; each coordinate is rounded once.
TriMesh moved_by(const TriMesh& mesh, const Vec3& by);

}  // namespace geom
