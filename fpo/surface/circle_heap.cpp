#include "fpo/surface/circle_heap.h"

#include <algorithm>
#include <functional>

#include "geom/check.h"

namespace fpo {

using geom::EmptyCircle;

namespace {

constexpr std::size_t share = 16;  // one circle in so many is above a new bar
constexpr std::size_t few = 64;    // circles need no bar

}  // namespace

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

bool CircleHeap::belongs(const EmptyCircle& circle) const {
  return priority_(circle) >= bar_ && is_offered(circle);
}

void CircleHeap::apply(const geom::RestrictedDual::Change& change) {
  if (bar_ == none) return;
  for (const CircleId c : change.circles_erased)
    if (heap_.contains(c)) heap_.erase(c);
  for (const CircleId c : change.circles_created)
    if (const EmptyCircle& circle = dual_.circle(c); belongs(circle)) heap_.push(c, priority_(circle));
  for (const CircleId c : change.circles_moved) {
    const EmptyCircle& circle = dual_.circle(c);
    const bool listed = heap_.contains(c), wanted = belongs(circle);
    if (listed && wanted) heap_.update(c, priority_(circle));
    if (listed && !wanted) heap_.erase(c);
    if (!listed && wanted) heap_.push(c, priority_(circle));
  }
}

CircleId CircleHeap::top() {
  if ((heap_.empty() && bar_ > all) || heap_.size() > most_) refill();
  return heap_.empty() ? CircleId() : heap_.top().slot;
}

void CircleHeap::refill() {
  std::vector<CircleId> circles = dual_.circles();
  std::erase_if(circles, [&](CircleId c) { return !is_offered(dual_.circle(c)); });
  std::vector<double> key_of;
  key_of.reserve(circles.size());
  for (const CircleId c : circles) key_of.push_back(priority_(dual_.circle(c)));
  std::vector<double> keys = key_of;
  bar_ = all;
  if (keys.size() >= few) {
    const auto nth = keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / share);
    std::ranges::nth_element(keys, nth, std::greater<>());
    if (*nth < none) bar_ = *nth;
  }
  heap_ = Heap(Order{&dual_});
  for (std::size_t i = 0; i < circles.size(); ++i)
    if (key_of[i] >= bar_) heap_.push(circles[i], key_of[i]);
  most_ = std::max(2 * heap_.size(), keys.size() / 2 + few);
}

void CircleHeap::forget() {
  heap_ = Heap(Order{&dual_});
  bar_ = none;
}

CircleId CircleHeap::first_on(std::span<const SiteId> cells) const {
  CircleId best;
  for (const SiteId y : cells)
    for (const CircleId c : dual_.circles_of(y))
      if (!best.valid() || priority_.goes_before(dual_.circle(c), dual_.circle(best))) best = c;
  return best;
}

void CircleHeap::check() const {
  if (bar_ == none) return;
  heap_.check();
  std::size_t above = 0;
  for (const CircleId c : dual_.circles()) {
    const bool is_above = belongs(dual_.circle(c));
    above += is_above;
    geom::ensure(is_above == heap_.contains(c), "circle heap: a circle is on the wrong side of the bar");
    geom::ensure(!is_above || heap_.key(c) == priority_(dual_.circle(c)),
                 "circle heap: a key is out of date");
  }
  geom::ensure(above == heap_.size(), "circle heap: entries of circles that are gone");
}

}  // namespace fpo
