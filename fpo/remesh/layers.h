#pragma once
// How thick the layers of a surface lie.

#include "geom/mesh/trimesh.h"

namespace fpo {

/// How many sheets lie within `distance` of one another: the area within that distance of a point of the
/// surface in areas of a disk, the median over 64 points drawn evenly. 1 on a smooth surface, 2 on a thin
/// plate, 100 on a stack of fifty plates. An estimate by random points: four times as many as disks
/// have the surface's area, at least 4096 and at most 400,000. 0 if the surface has no area. Deterministic.
/// O(F + points log F).
double layers_within(const geom::TriMesh& mesh, double distance);

}  // namespace fpo
