#include "fpo/surface/circle_heap.h"

namespace fpo {

using geom::EmptyCircle;

bool SurfacePriority::goes_before(const EmptyCircle& a, const EmptyCircle& b) const {
  const double of_a = (*this)(a), of_b = (*this)(b);
  return of_a > of_b || (of_a == of_b && circle_before(a, b));
}

CircleHeap::CircleHeap(const geom::RestrictedDual& dual, const SurfacePriority& priority,
                       const MoveGuard* guard)
    : dual_(dual), priority_(priority), guard_(guard), heap_(Order{&dual}) {}

bool CircleHeap::is_offered(const EmptyCircle& circle) const {
  return !guard_ || guard_->offers(circle, dual_.site(circle.sites[0]));
}

void CircleHeap::apply(const geom::RestrictedDual::Change& change) {
  for (const CircleId c : change.circles_erased)
    if (heap_.contains(c)) heap_.erase(c);
  for (const CircleId c : change.circles_created) {
    const EmptyCircle& circle = dual_.circle(c);
    if (is_offered(circle)) heap_.push(c, priority_(circle));
  }
  for (const CircleId c : change.circles_moved) {
    const EmptyCircle& circle = dual_.circle(c);
    const bool listed = heap_.contains(c), offered = is_offered(circle);
    if (listed && offered) heap_.update(c, priority_(circle));
    if (listed && !offered) heap_.erase(c);
    if (!listed && offered) heap_.push(c, priority_(circle));
  }
}

CircleId CircleHeap::first_on(std::span<const SiteId> cells) const {
  CircleId best;
  for (const SiteId y : cells)
    for (const CircleId c : dual_.circles_of(y))
      if (!best.valid() || priority_.goes_before(dual_.circle(c), dual_.circle(best))) best = c;
  return best;
}

}  // namespace fpo
