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
/// A goal for delta is reached soonest if samples rest at a spacing little above it; a margin leaves a larger
/// mean delta. With this one `fpo-remesh homer.obj -n 7900 --tiles off --target-delta 0.9` takes 7 moves a
/// sample with --rest and 15 without; their mean delta is .920 and .927. Goals near what FPO reaches at all
/// (.92 and more) gain nothing.
inline constexpr double rest_margin = 0.005;

/// Those of the samples, in their order, that do not rest: which have less than this spacing
/// (Domain::normalized_spacing), or a neighbour that has. The domain must know neighbours(). Cost: the
/// spacings.
std::vector<SiteId> restless(Domain& domain, std::span<const SiteId> samples, double rest_spacing);

}  // namespace fpo
