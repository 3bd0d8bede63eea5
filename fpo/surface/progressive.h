#pragma once
// An order of samples in which every beginning is well spread: of n samples the first k serve as a smaller
// set.

#include <cstddef>
#include <span>
#include <vector>

#include "geom/vec.h"

namespace fpo {

/// The rank of each point, from 0, by farthest point traversal: sample 0 comes first, then always the point
/// whose distance to all before it, over its wanted length, is largest (of equal ones the first). So any two
/// of the first k are at least as far apart, by the later one's length, as any other point is from them.
/// Distances are straight ones; lengths are positive. O(n log^2 n) expected. Deterministic.
std::vector<std::size_t> progressive_ranks(std::span<const geom::Vec3> points,
                                           std::span<const double> wanted);

}  // namespace fpo
