#pragma once
// Points along a Hilbert curve: neighbours in the plane or in space become neighbours in memory.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/vec.h"

namespace geom {

/// The place of a cell of the 2^20 x 2^20 grid along the Hilbert curve through all of them.
std::uint64_t hilbert_index(std::uint32_t column, std::uint32_t row);

/// The indices of the points in the order in which the curve through [0, extent) visits them; points in the
/// same cell of its grid keep their order. O(n log n).
std::vector<std::uint32_t> hilbert_order(const std::vector<Vec2>& points, const Vec2& extent);

/// The place of a cell of the 2^20 x 2^20 x 2^20 grid along the Hilbert curve through all of them
/// (Hamilton, Compact Hilbert Indices, 2006).
std::uint64_t hilbert_index(const std::array<std::uint32_t, 3>& cell);

/// The same order in space, for points in a cube at the lower corner of `box` as wide as its longest side.
std::vector<std::uint32_t> hilbert_order(const std::vector<Vec3>& points, const Box3& box);

}  // namespace geom
