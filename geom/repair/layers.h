#pragma once
// How thick the layers of a surface lie.

#include "geom/mesh/trimesh.h"

namespace geom {

/// How many sheets lie within `distance` of one another: the area within that distance of a point of the
/// surface in areas of a disk, the median over 64 points drawn evenly. 1 on a smooth surface, 2 on a thin
/// plate, 100 on a stack of fifty plates. The area is counted by at least 4096 points: right to a quarter, as
/// a rule. 0 if the surface has no area. Deterministic. O(F + area / distance^2).
double layers_within(const TriMesh& mesh, double distance);

}  // namespace geom
