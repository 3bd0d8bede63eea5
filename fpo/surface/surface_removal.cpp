#include "fpo/surface/surface_removal.h"

#include <algorithm>

namespace fpo {

using geom::EmptyCircle;
using geom::RestrictedDual;

SurfaceRemoval::SurfaceRemoval(SurfaceDomain& domain, SiteId x)
    : domain_(domain), x_(x), plan_(domain.dual_->plan_removal(x)) {
  if (!plan_) carry_out();
}

void SurfaceRemoval::carry_out() {
  if (plan_) cancel();
  plan_.reset();
  if (domain_.guard_) reach_ = domain_.reach(x_);
  domain_.remove(x_);
}

std::span<const SiteId> SurfaceRemoval::heirs() const {
  return plan_ ? plan_->heirs : domain_.last_change().cells;
}

SurfaceRemoval::Vacancy SurfaceRemoval::vacancy() {
  if (plan_) return {plan_->heirs, plan_->reach, plan_->max_radius2};
  around_.assign(heirs().begin(), heirs().end());
  if (around_.empty()) around_.push_back(domain_.nearest_to(x_).site);
  double power = 0;
  for (const SiteId heir : around_) power = std::max(power, domain_.reach(heir));
  return {around_, reach_, power};
}

bool SurfaceRemoval::sharpen() {
  if (!plan_ || is_sharp_) return false;
  plan_ = domain_.dual_->plan_exactly(x_);
  return is_sharp_ = true;
}

bool SurfaceRemoval::find_largest(Scope scope) {
  largest_ = nullptr;
  if (plan_) {
    find_planned(scope);
    return largest_ != nullptr;
  }
  id_ = domain_.largest_empty(scope).id;
  if (id_.valid()) largest_ = &domain_.dual().circle(id_);
  return true;
}

/// Among the circles that the hole would have, and all others in scope that do not touch x.
void SurfaceRemoval::find_planned(Scope scope) {
  const RestrictedDual& dual = domain_.dual();
  const auto consider = [&](const EmptyCircle& circle, const RestrictedDual::Target& target) {
    if (largest_ && !domain_.goes_before(circle, *largest_)) return;
    largest_ = &circle;
    target_ = target;
  };
  for (std::size_t i = 0; i < plan_->circles.size(); ++i)
    if (scope == Scope::two_ring || domain_.is_offered(plan_->circles[i]))
      consider(plan_->circles[i], {i, CircleId()});
  if (scope == Scope::two_ring) {
    for (const SiteId y : plan_->heirs)
      for (const CircleId c : dual.circles_of(y))
        if (!dual.circle(c).touches(x_)) consider(dual.circle(c), {0, c});
  } else if (!domain_.circles_.empty()) {
    const CircleId top = domain_.circles_.top().slot;
    consider(dual.circle(top), {0, top});
  }
  if (largest_ && largest_->touches(x_)) largest_ = nullptr;
}

void SurfaceRemoval::insert() {
  if (!plan_) return domain_.insert_at(x_, {largest_->radius2, id_});
  domain_.samples_[x_] = {largest_->center, largest_->facet};
  domain_.apply(domain_.dual_->move(x_, domain_.point_of(x_), domain_.samples_[x_].facet, target_));
}

void SurfaceRemoval::cancel() {
  if (!plan_) return domain_.put_back(x_);
  domain_.apply(domain_.dual_->stay(x_));
}

}  // namespace fpo
