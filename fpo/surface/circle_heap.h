#pragma once
// Line 6 of Algorithm 1 on a surface: the empty circles by how far their centers are (farthest.h), the
// farthest first.

#include <span>

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

/// The circles of a dual under change that a guard, if there is one, offers.
class CircleHeap {
 public:
  /// Empty. Keeps references.
  CircleHeap(const geom::RestrictedDual& dual, const SurfacePriority& priority, const MoveGuard* guard);

  const SurfacePriority& priority() const { return priority_; }
  /// May this circle, of the dual or not, be the farthest point?
  bool is_offered(const geom::EmptyCircle& circle) const;

  /// Follows one change of the dual. O(log n) a circle.
  void apply(const geom::RestrictedDual::Change& change);
  /// The first of all; none if there is none.
  CircleId top() const { return heap_.empty() ? CircleId() : heap_.top().slot; }
  /// The first of those on these cells, offered or not; none if there is none.
  CircleId first_on(std::span<const SiteId> cells) const;
  /// Throws geom::Bug. O(circles).
  void check() const { heap_.check(); }

 private:
  struct Order {
    const geom::RestrictedDual* dual;
    bool operator()(CircleId a, CircleId b) const { return circle_before(dual->circle(a), dual->circle(b)); }
  };

  const geom::RestrictedDual& dual_;
  SurfacePriority priority_;
  const MoveGuard* guard_;
  geom::IndexedHeap<CircleId, Order> heap_;
};

}  // namespace fpo
