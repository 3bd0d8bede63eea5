#pragma once
// Rest: no work for samples that have what is wanted. Plain farthest point optimization moves every sample in
// every iteration, most by less and less; only where samples are too close does that raise delta.

#include <limits>
#include <span>
#include <vector>

#include "fpo/domain.h"

namespace fpo {

/// Spacing at which nobody rests: Algorithm 1.
inline constexpr double no_rest = std::numeric_limits<double>::infinity();
/// A goal for delta is reached soonest if samples rest at a slightly larger spacing. Measured on homer, 7900 samples,
/// to delta .9: 15 moves a sample without rest, 5.8 with a margin of 0, 7.0 with .005, 8.5 with .01; mean delta is
/// .927, .918, .920, .921 then. Goals near what FPO reaches at all (.92 and more) gain nothing.
inline constexpr double rest_margin = 0.005;

/// Those of the samples, in their order, that do not rest: which have less than this spacing
/// (Domain::normalized_spacing), or a neighbour that has. The domain must know neighbours(). Cost: the spacings.
std::vector<SiteId> restless(Domain& domain, std::span<const SiteId> samples, double rest_spacing);

}  // namespace fpo
