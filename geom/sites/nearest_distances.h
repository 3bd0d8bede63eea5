#pragma once
// How far points are from each other.

#include <cstddef>
#include <span>
#include <vector>

#include "geom/vec.h"

namespace geom {

/// The distance of each point from `first` on to the nearest other one of all; +infinity if there is no
/// other. O(n log n). `threads` at least 1; no matter to the result.
std::vector<double> nearest_distances(std::span<const Vec3> points, std::size_t first = 0, int threads = 1);

}  // namespace geom
