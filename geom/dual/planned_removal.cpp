#include "geom/dual/planned_removal.h"

#include "geom/dual/dual_updates.h"

namespace geom {

std::optional<PlannedRemoval> PlannedRemoval::of(SiteId p, DualUpdates& updates) {
  updates.begin();
  if (updates.fast_.plan(p)) return PlannedRemoval(p, updates, true);
  const DualState& state = updates.state_;
  if (state.corners.types() == CornerTypes::all || state.reach[p] == Reaches::of_nothing) return {};
  GeneralRemoval& removal = updates.redivision_.removal();
  removal.plan(p);
  if (!removal.has_neighbours()) return {};
  return PlannedRemoval(p, updates, false);
}

PlannedRemoval::PlannedRemoval(SiteId p, DualUpdates& updates, bool is_fast)
    : updates_(&updates), p_(p), is_fast_(is_fast) {
  read();
}

void PlannedRemoval::read() {
  const FastWay& fast = updates_->fast_;
  const GeneralRemoval& removal = updates_->redivision_.removal();
  if (is_fast_)
    hole_ = {fast.rim(), fast.circles(), fast.reach(), fast.max_radius2()};
  else
    hole_ = {removal.heirs(), removal.circles(), removal.reach(), removal.power()};
}

void PlannedRemoval::sharpen() {
  if (is_fast_ && !updates_->fast_.make_plan_exact()) {
    updates_->fast_.cancel();
    updates_->redivision_.removal().plan(p_);
    is_fast_ = false;
  }
  read();
}

const DualChange& PlannedRemoval::cancel() {
  if (is_fast_) updates_->fast_.cancel();
  return updates_->change_;
}

const DualChange& PlannedRemoval::move(const WeightedPoint3& point, FacetId home, Target target) {
  return updates_->move(p_, point, home, target, is_fast_);
}

}  // namespace geom
