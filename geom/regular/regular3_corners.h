#pragma once
// Corners of the facets of a tetrahedron.

#include <array>
#include <cstddef>

#include "geom/ids.h"

namespace geom {

/// The facet opposite corner i, turned such that corner i is on its positive side: (a, b, c, corner i) is an
/// even permutation of the corners.
inline std::array<SiteId, 3> facet_corners(const std::array<SiteId, 4>& corner, int i) {
  constexpr std::size_t table[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
  return {corner[table[i][0]], corner[table[i][1]], corner[table[i][2]]};
}

}  // namespace geom
