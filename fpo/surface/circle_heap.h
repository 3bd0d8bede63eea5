#pragma once
// Line 6 of Algorithm 1 on a surface: the empty circles by how far their centers are (farthest.h), the
// farthest first.

#include <limits>
#include <span>
#include <vector>

#include "fpo/domain.h"
#include "fpo/farthest.h"
#include "fpo/surface/move_guard.h"
#include "fpo/surface/sizing.h"
#include "geom/dual/restricted_dual.h"
#include "geom/indexed_heap.h"

namespace fpo {

/// How far places on a surface are.
struct SurfacePriority {
  Priority rule = by_radius;
  const Sizing& sizing;

  double operator()(const SurfaceSample& place, double radius2) const {
    return priority_by(rule, place.position, radius2, [&] { return sizing.at(place); });
  }
  double operator()(const geom::EmptyCircle& c) const {
    return priority_by(rule, c.center, c.radius2, [&] { return sizing.at({c.center, c.facet}); });
  }
  /// The order of line 6: by priority; among equals by what the circles are.
  bool goes_before(const geom::EmptyCircle& a, const geom::EmptyCircle& b) const;
};

/// The circles of a dual under change that a guard, if there is one, offers. What the guard says of a circle
/// must not change until the circle does.
///
/// Farthest point optimization only ever asks for the top, and most circles never are. So the heap holds
/// those whose priority is not below a bar, some percent of them: all others are below its top. When these
/// are used up (or have become too many) the bar is set anew by one pass over all circles. The answer is that
/// of a heap of all; most changes never touch it, and none does until somebody asks.
class CircleHeap {
 public:
  /// Empty. Keeps references.
  CircleHeap(const geom::RestrictedDual& dual, const SurfacePriority& priority, const MoveGuard* guard);

  const SurfacePriority& priority() const { return priority_; }
  /// May this circle, of the dual or not, be the farthest point?
  bool is_offered(const geom::EmptyCircle& circle) const;

  /// Follows one change of the dual. O(1) a circle, O(log n) at or above the bar.
  void apply(const geom::RestrictedDual::Change& change);
  /// The first of all; none if there is none.
  CircleId top();
  /// The first of those on these cells, offered or not; none if there is none.
  CircleId first_on(std::span<const SiteId> cells) const;
  /// Gives back its memory, and follows nothing, until top() is asked again.
  void forget();
  /// Is every circle on its side of the bar? Throws geom::Bug. O(circles).
  void check() const;

 private:
  struct Order {
    const geom::RestrictedDual* dual;
    bool operator()(CircleId a, CircleId b) const { return circle_before(dual->circle(a), dual->circle(b)); }
  };

  using Heap = geom::IndexedHeap<CircleId, Order>;

  static constexpr double none = std::numeric_limits<double>::infinity(), all = -none;  ///< bars

  bool belongs(const geom::EmptyCircle& circle) const;
  void refill();

  const geom::RestrictedDual& dual_;
  SurfacePriority priority_;
  const MoveGuard* guard_;
  Heap heap_;             ///< all that are offered with priority >= bar_
  double bar_ = none;     ///< at first nobody has asked for the top
  std::size_t most_ = 0;  ///< more entries than these call for a higher bar
};

}  // namespace fpo
