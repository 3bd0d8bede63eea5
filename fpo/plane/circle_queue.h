#pragma once
// The priority queue of section 3.2: triangles by how far their dual vertices are (farthest.h), the farthest
// first.

#include <vector>

#include "fpo/domain.h"
#include "fpo/farthest.h"
#include "fpo/plane/plane_weights.h"
#include "geom/indexed_heap.h"
#include "geom/regular/regular2.h"

namespace fpo {

/// How far places in the plane are.
struct PlanePriority {
  Priority rule = by_radius;
  const PlaneWeights& weights;

  double operator()(const geom::Vec2& at, double radius2) const {
    return rule == by_radius ? radius2 : by_place(at, radius2);
  }

 private:
  double by_place(const geom::Vec2& at, double radius2) const;
};

/// The farthest empty circle of a triangulation under change. Farthest point optimization only ever asks for
/// the top, so only the circles above a bar are kept in order: about an eighth of them. When they are used up
/// (or have become too many) the bar is set anew by one pass over all triangles. The answer is that of a heap
/// of all circles; most changes never touch the heap, whose memory stays small.
class CircleQueue {
 public:
  /// Keeps a reference. Empty until the first top().
  CircleQueue(const geom::Regular2& triangulation, const PlanePriority& priority);

  double priority(const geom::Vec2& at, double radius2) const { return priority_(at, radius2); }
  double priority(geom::SimplexId t) const {
    return priority_(triangulation_.center(t), triangulation_.radius2(t));
  }
  /// The order of the queue: by priority; among equals by corners, the smallest first.
  bool goes_before(geom::SimplexId a, geom::SimplexId b) const;

  /// Follows one change of the triangulation. O(1) expected, O(log n) for a circle above the bar.
  void apply(const geom::Regular2::Change& change);
  /// The first of all.
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

  void refill();

  const geom::Regular2& triangulation_;
  PlanePriority priority_;
  Heap heap_;  ///< all circles with priority >= bar_
  double bar_;
  std::size_t most_ = 0;  ///< more entries than these call for a higher bar
  bool active_ = false;   ///< somebody has asked for the top
  /// Circles above the bar that the last change created. The next one destroys most of them (a removal opens
  /// a hole, the insertion closes it), so they enter the heap only if they survive it.
  std::vector<geom::SimplexId> fresh_;
  std::vector<double> scratch_;
};

}  // namespace fpo
