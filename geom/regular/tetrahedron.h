#pragma once
// Corners and facets of a tetrahedron.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geom/ids.h"

namespace geom {

/// The facet opposite corner i, turned such that corner i is on its positive side: (a, b, c, corner i) is an
/// even permutation of the corners.
inline std::array<SiteId, 3> facet_corners(const std::array<SiteId, 4>& corner, int i) {
  constexpr std::size_t table[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
  return {corner[table[i][0]], corner[table[i][1]], corner[table[i][2]]};
}

/// Which corner v is; 4 if it is none.
inline int corner_of(const std::array<SiteId, 4>& corner, SiteId v) {
  return static_cast<int>(std::find(corner.begin(), corner.end(), v) - corner.begin());
}

/// The facet of a tetrahedron opposite one of its corners; none outside the hull.
class TetrahedronFacet {
 public:
  TetrahedronFacet() = default;
  explicit TetrahedronFacet(std::int32_t code) : code_(code) {}
  TetrahedronFacet(SimplexId t, int corner) : code_(4 * t.value + corner) {}
  bool valid() const { return code_ >= 0; }
  SimplexId simplex() const { return SimplexId(code_ >> 2); }
  int corner() const { return code_ & 3; }
  std::int32_t code() const { return code_; }
  bool operator==(const TetrahedronFacet&) const = default;

 private:
  std::int32_t code_ = -1;
};

}  // namespace geom
