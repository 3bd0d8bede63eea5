#pragma once
// Where methods begin that move all samples at once.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Random ones if none is fixed. Else those that are fixed, then random ones, none within .7 h of another as
/// far as there is room: a sample that starts between two neighbours on a crease never gets out from between
/// them, and a face that has some percent too many never gets rid of them. Throws geom::InputError like
/// random_samples(). O(n log n).
std::vector<SurfaceSample> first_samples(const BaselineTask& task);

}  // namespace fpo
