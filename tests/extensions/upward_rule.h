#pragma once
// A rule for the farthest point: of two circles, the upper one counts more.

#include "fpo/farthest.h"

namespace fpo {

inline double upward(const Place& place) { return place.radius2 + 0.05 * place.position.z(); }

}  // namespace fpo
