#pragma once
// The angles that the input itself has between its features: no remesh that keeps these has larger ones.

#include "fpo/features/features.h"

namespace fpo {

/// The smallest angle along the surface between two edges of features that follow each other around a vertex,
/// in degrees; 180 if there is none smaller. O(F log F).
double smallest_corner_angle(const geom::TriMesh& mesh, const Features& features);

}  // namespace fpo
