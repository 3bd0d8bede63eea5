#pragma once
// How a hole in the plane is filled by the regular triangles of its corners, by gift wrapping. Every triangle
// has a chord or edge of the hole and, of the corners beyond it, the one whose circle with the chord contains
// no other.
//
//          apex
//           *           A chord (last, first) closes the chain first .. last of the hole's corners. Its
//         /   \         triangle's apex splits it into two shorter chains; the first chord is the edge
//      __/     \__      from the last corner of the whole hole to its first. All numbers are seen from the
//   last -------> first removed site, so they are small and exact.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/regular/power_circle.h"

namespace geom {

/// One object serves many holes.
class HolePlan2 {
 public:
  /// Corners of the hole (places among them), and the triangle on the chord (last, first).
  struct Chain {
    std::int32_t first, apex, last;
    std::array<std::int32_t, 2> child;  ///< chains of the chords (first, apex), (apex, last); -1: an edge
  };

  /// Plans the filling of a polygon, corners counterclockwise, whose regular triangulation fills it.
  /// O(k^2) for k corners.
  void plan(std::span<const SeenSite> rim);
  /// Parents before children: the first is on the edge from the last corner to the first.
  std::span<const Chain> chains() const { return chains_; }

 private:
  struct Bounds {
    double orientation, comparison;  ///< of the errors of the two filters
  };
  struct Chord {
    std::int32_t first, last, parent, which;  ///< which child of the parent
  };
  Bounds error_bounds() const;
  std::int32_t apex(std::int32_t first, std::int32_t last, const Bounds& bounds) const;

  std::span<const SeenSite> rim_;
  std::vector<Chain> chains_;
  std::vector<Chord> pending_;
};

}  // namespace geom
