#pragma once
// delta and mean delta of samples without a diagram.

#include <cstddef>
#include <span>

#include "fpo/optimize.h"
#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_sample.h"

namespace fpo {

/// delta and its mean by distances over h to the nearest other sample in space, like measure() of a domain
/// without weights: the first `num_fixed` samples left out unless they are all. O(n log n). `threads` at
/// least 1; no matter to the result.
IterationReport measure_positions(std::span<const SurfaceSample> samples, const Sizing& sizing,
                                  std::size_t num_fixed, int threads);

}  // namespace fpo
