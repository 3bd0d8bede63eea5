#include "fpo/surface/surface_removal.h"

#include <algorithm>

namespace fpo {

using geom::EmptyCircle;
using geom::RestrictedDual;

SurfaceRemoval::SurfaceRemoval(SurfaceDomain& domain, SurfaceState& state, SiteId x)
    : domain_(domain), state_(state), x_(x), plan_(state.dual.plan_removal(x)) {
  if (!plan_) carry_out();
}

void SurfaceRemoval::carry_out() {
  if (plan_) cancel();
  plan_.reset();
  if (state_.guard) reach_ = domain_.reach(x_);
  domain_.remove(x_);
}

std::span<const SiteId> SurfaceRemoval::heirs() const {
  return plan_ ? plan_->heirs() : domain_.last_change().cells;
}

SurfaceRemoval::Vacancy SurfaceRemoval::vacancy() {
  if (plan_) return {plan_->heirs(), plan_->reach(), plan_->max_radius2()};
  around_.assign(heirs().begin(), heirs().end());
  if (around_.empty()) around_.push_back(state_.nearest_to(x_).site);
  double power = 0;
  for (const SiteId heir : around_) power = std::max(power, domain_.reach(heir));
  return {around_, reach_, power};
}

bool SurfaceRemoval::sharpen() {
  if (!plan_ || is_sharp_) return false;
  plan_->sharpen();
  return is_sharp_ = true;
}

bool SurfaceRemoval::find_largest(Scope scope) {
  largest_ = nullptr;
  if (plan_) {
    find_planned(scope);
    return largest_ != nullptr;
  }
  id_ = domain_.largest_empty(scope).id;
  if (id_.valid()) largest_ = &state_.dual.circle(id_);
  return true;
}

/// Among the circles that the hole would have, and all others in scope that do not touch x.
void SurfaceRemoval::find_planned(Scope scope) {
  const RestrictedDual& dual = state_.dual;
  CircleHeap& heap = state_.circles;
  const auto is_larger = [&](const EmptyCircle& circle) {
    return !largest_ || heap.priority().goes_before(circle, *largest_);
  };
  const auto take = [&](const EmptyCircle& circle, const geom::PlannedRemoval::Target& target) {
    largest_ = &circle;
    target_ = target;
  };
  const auto consider = [&](CircleId c) {
    if (const EmptyCircle& circle = dual.circle(c); is_larger(circle)) take(circle, {0, c});
  };
  for (std::size_t i = 0; i < plan_->circles().size(); ++i)
    if (const EmptyCircle& circle = plan_->circles()[i];
        is_larger(circle) && (scope == Scope::two_ring || heap.is_offered(circle)))
      take(circle, {i, CircleId()});
  if (scope == Scope::two_ring) {
    for (const SiteId y : plan_->heirs())
      for (const CircleId c : dual.circles_of(y))
        if (!dual.circle(c).touches(x_)) consider(c);
  } else if (const CircleId top = heap.top(); top.valid()) {
    consider(top);
  }
  if (largest_ && largest_->touches(x_)) largest_ = nullptr;
}

void SurfaceRemoval::insert() {
  if (!plan_) return domain_.insert_at(x_, {largest_->radius2, id_});
  const SurfaceSample place{largest_->center, largest_->facet};
  const auto& change = plan_->move(state_.point_at(place, x_), place.facet, target_);
  state_.samples.put(x_, place);
  state_.apply(change);
}

void SurfaceRemoval::cancel() {
  if (!plan_) return domain_.put_back(x_);
  state_.apply(plan_->cancel());
}

}  // namespace fpo
