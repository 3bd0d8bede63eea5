#include "fpo/plane/circle_queue.h"

#include <algorithm>
#include <functional>

#include "geom/check.h"

namespace fpo {

using geom::SimplexId;

namespace {

constexpr std::size_t share = 8;  ///< one circle in so many is above a new bar

}  // namespace

CircleQueue::CircleQueue(const geom::Regular2& triangulation)
    : triangulation_(triangulation), heap_(Order{&triangulation}), bar_(0) {}

void CircleQueue::apply(const geom::Regular2::Change& change) {
  if (!active_) return;
  for (const SimplexId t : change.destroyed)
    if (heap_.contains(t)) heap_.erase(t);
  for (const SimplexId t : fresh_)
    if (std::ranges::find(change.destroyed, t) == change.destroyed.end())
      heap_.push(t, triangulation_.radius2(t));
  fresh_.clear();
  for (const SimplexId t : change.created) {
    if (triangulation_.radius2(t) >= bar_) fresh_.push_back(t);
  }
}

bool CircleQueue::larger(SimplexId a, SimplexId b) const {
  const double ra = triangulation_.radius2(a), rb = triangulation_.radius2(b);
  return ra > rb || (ra == rb && triangulation_.simplex_before(a, b));
}

SimplexId CircleQueue::top() {
  if (!active_ || heap_.empty() || heap_.size() > most_) refill();
  SimplexId best = heap_.top().slot;
  for (const SimplexId t : fresh_) {
    if (larger(t, best)) best = t;
  }
  return best;
}

void CircleQueue::refill() {
  active_ = true;
  fresh_.clear();
  scratch_.clear();
  const std::size_t capacity = triangulation_.simplex_capacity();
  for (SimplexId t(0); t.index() < capacity; ++t.value)
    if (triangulation_.is_live(t)) scratch_.push_back(triangulation_.radius2(t));
  const auto nth = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / share);
  std::nth_element(scratch_.begin(), nth, scratch_.end(), std::greater<>());
  bar_ = *nth;
  heap_ = Heap(Order{&triangulation_});
  for (SimplexId t(0); t.index() < capacity; ++t.value) {
    if (triangulation_.is_live(t) && triangulation_.radius2(t) >= bar_)
      heap_.push(t, triangulation_.radius2(t));
  }
  most_ = std::max(2 * heap_.size(), scratch_.size() / 2);
}

void CircleQueue::check() const {
  if (!active_) return;
  heap_.check();
  std::size_t above = 0;
  for (SimplexId t(0); t.index() < triangulation_.simplex_capacity(); ++t.value) {
    if (!triangulation_.is_live(t)) continue;
    const double radius2 = triangulation_.radius2(t);
    above += radius2 >= bar_;
    const bool fresh = std::find(fresh_.begin(), fresh_.end(), t) != fresh_.end();
    geom::ensure((radius2 >= bar_) == (heap_.contains(t) || fresh),
                 "circle queue: a circle is on the wrong side of the bar");
    geom::ensure(!(fresh && heap_.contains(t)), "circle queue: a circle is in twice");
    geom::ensure(!heap_.contains(t) || heap_.key(t) == radius2, "circle queue: a key is out of date");
  }
  geom::ensure(above == heap_.size() + fresh_.size(), "circle queue: entries of dead triangles");
}

}  // namespace fpo
