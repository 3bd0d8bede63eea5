#pragma once
// Eight far samples around all sites in space, so that every site lies strictly inside the hull and coplanar
// input needs no special case.

#include <cmath>
#include <cstdint>

#include "geom/ids.h"
#include "geom/vec.h"

namespace geom {

/// They are sites of weight 0 with negative ids below none.
constexpr int guard_count = 8;
constexpr SiteId guard(int k) { return SiteId(-2 - k); }
constexpr bool is_guard(SiteId id) { return id.value < -1; }

/// The place of a site or guard in the symbolic perturbation: its id; guards come last, so they lose ties.
constexpr std::int32_t perturbation_rank(SiteId id) {
  return id.value >= 0 ? id.value : INT32_MAX + (id.value + 2);
}

/// Eight corners of a cube of half side 16 about the box, each pushed outwards by up to 1/16 of that, all by
/// different amounts; the unit is the diagonal.
///
/// In the octant of signs s the guard g has s.g >= 48 while any other corner has s.g <= 2 * 17 - 16, so each
/// guard is a corner of the hull whatever the weights: it cannot be hidden. In any direction u some guard
/// reaches as far as the cube's corner, so the hull contains the cube and with it the box, strictly. And |g -
/// x| >= 16 sqrt(3) - 1 > 10 for x in the box.
inline Vec3 guard_position(int k, const Vec3& center, double unit) {
  Vec3 at;
  for (int axis = 0; axis < 3; ++axis) {
    const double golden = 0.6180339887498949 * (3 * k + axis + 1);
    const double reach = 16 + (golden - std::floor(golden));
    at[axis] = center[axis] + ((k >> axis & 1) ? reach : -reach) * unit;
  }
  return at;
}

}  // namespace geom
