#pragma once
// The angles that the input itself has between its features: no remesh that keeps these has larger ones.

#include <cstddef>

#include "fpo/features/features.h"

namespace fpo {

/// Angles along the surface between two edges of features that follow each other around a vertex.
struct CornerAngles {
  double smallest = 180;     ///< degrees; no larger ones are looked at
  std::size_t below_30 = 0;  ///< how many are less than that
};

/// O(F log F).
CornerAngles corner_angles(const geom::TriMesh& mesh, const Features& features);

}  // namespace fpo
