#pragma once
// The priority queue of section 3.2: triangles by the power of their dual vertex, the largest first.

#include <vector>

#include "fpo/domain.h"
#include "geom/indexed_heap.h"
#include "geom/regular/regular2.h"

namespace fpo {

/// The largest empty circle of a triangulation under change. Farthest point optimization only ever asks for
/// the top, so only the circles above a bar are kept in order: about an eighth of them. When they are used up
/// (or have become too many) the bar is set anew by one pass over all triangles. The answer is that of a heap
/// of all circles; most changes never touch the heap, whose memory stays small.
class CircleQueue {
 public:
  /// Keeps a reference. Empty until the first top().
  explicit CircleQueue(const geom::Regular2& triangulation);

  /// Follows one change of the triangulation. O(1) expected, O(log n) for a circle above the bar.
  void apply(const geom::Regular2::Change& change);
  /// The largest circle; among equals the triangle with the smallest corners.
  geom::SimplexId top();
  /// Compares the top with a search in all triangles. O(n). Throws geom::Bug.
  void check() const;

 private:
  struct Order {
    const geom::Regular2* triangulation;
    bool operator()(geom::SimplexId a, geom::SimplexId b) const {
      return triangulation->simplex_before(a, b);
    }
  };
  using Heap = geom::IndexedHeap<geom::SimplexId, Order>;

  bool larger(geom::SimplexId a, geom::SimplexId b) const;
  void refill();

  const geom::Regular2& triangulation_;
  Heap heap_;  ///< all circles with radius2 >= bar_
  double bar_;
  std::size_t most_ = 0;  ///< more entries than these call for a higher bar
  bool active_ = false;   ///< somebody has asked for the top
  /// Circles above the bar that the last change created. The next one destroys most of them (a removal opens
  /// a hole, the insertion closes it), so they enter the heap only if they survive it.
  std::vector<geom::SimplexId> fresh_;
  std::vector<double> scratch_;
};

}  // namespace fpo
