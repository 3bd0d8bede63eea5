#include "fpo/plane/circle_queue.h"

#include <algorithm>
#include <functional>

#include "geom/check.h"

namespace fpo {

using geom::SimplexId;

namespace {

constexpr std::size_t share = 8;  ///< one circle in so many is above a new bar

}  // namespace

double PlanePriority::by_place(const geom::Vec2& at, double radius2) const {
  return rule({{at.x(), at.y(), 0}, radius2, weights.edge_length(at)});
}

CircleQueue::CircleQueue(const geom::Regular2& triangulation, const PlanePriority& priority)
    : triangulation_(triangulation), priority_(priority), heap_(Order{&triangulation}), bar_(0) {}

void CircleQueue::apply(const geom::Regular2::Change& change) {
  if (!active_) return;
  for (const SimplexId t : change.destroyed)
    if (heap_.contains(t)) heap_.erase(t);
  for (const SimplexId t : fresh_)
    if (std::ranges::find(change.destroyed, t) == change.destroyed.end()) heap_.push(t, priority(t));
  fresh_.clear();
  for (const SimplexId t : change.created) {
    if (priority(t) >= bar_) fresh_.push_back(t);
  }
}

bool CircleQueue::goes_before(SimplexId a, SimplexId b) const {
  const double of_a = priority(a), of_b = priority(b);
  return of_a > of_b || (of_a == of_b && triangulation_.simplex_before(a, b));
}

SimplexId CircleQueue::top() {
  if (!active_ || heap_.empty() || heap_.size() > most_) refill();
  SimplexId best = heap_.top().slot;
  for (const SimplexId t : fresh_) {
    if (goes_before(t, best)) best = t;
  }
  return best;
}

void CircleQueue::refill() {
  active_ = true;
  fresh_.clear();
  scratch_.clear();
  const std::size_t capacity = triangulation_.simplex_capacity();
  for (SimplexId t(0); t.index() < capacity; ++t.value)
    if (triangulation_.is_live(t)) scratch_.push_back(priority(t));
  const auto nth = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / share);
  std::nth_element(scratch_.begin(), nth, scratch_.end(), std::greater<>());
  bar_ = *nth;
  heap_ = Heap(Order{&triangulation_});
  for (SimplexId t(0); t.index() < capacity; ++t.value) {
    if (triangulation_.is_live(t) && priority(t) >= bar_) heap_.push(t, priority(t));
  }
  most_ = std::max(2 * heap_.size(), scratch_.size() / 2);
}

void CircleQueue::check() const {
  if (!active_) return;
  heap_.check();
  std::size_t above = 0;
  for (SimplexId t(0); t.index() < triangulation_.simplex_capacity(); ++t.value) {
    if (!triangulation_.is_live(t)) continue;
    const double key = priority(t);
    above += key >= bar_;
    const bool fresh = std::find(fresh_.begin(), fresh_.end(), t) != fresh_.end();
    geom::ensure((key >= bar_) == (heap_.contains(t) || fresh),
                 "circle queue: a circle is on the wrong side of the bar");
    geom::ensure(!(fresh && heap_.contains(t)), "circle queue: a circle is in twice");
    geom::ensure(!heap_.contains(t) || heap_.key(t) == key, "circle queue: a key is out of date");
  }
  geom::ensure(above == heap_.size() + fresh_.size(), "circle queue: entries of dead triangles");
}

}  // namespace fpo
