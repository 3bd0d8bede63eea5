#pragma once
// Where methods begin that move all samples at once.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Those that are fixed, then random ones, none of them within .7 h of one that is fixed as far as there is
/// room: a sample that starts between two neighbours on a crease never gets out from between them. Throws
/// geom::InputError like random_samples(). O(n log n).
std::vector<SurfaceSample> first_samples(const BaselineTask& task);

}  // namespace fpo
