#include "geom/empty_circles.h"

#include "geom/check.h"

namespace geom {

CircleId EmptyCircles::create(const EmptyCircle& circle) {
  CircleId c;
  if (free_.empty()) {
    c = circles_.next_id();
    circles_.push_back(circle);
    links_.emplace_back();
  } else {
    c = free_.back();
    free_.pop_back();
    circles_[c] = circle;
  }
  enlist(c);
  return c;
}

void EmptyCircles::erase(CircleId c) {
  const std::array<SiteId, 3>& sites = circles_[c].sites;
  for (std::size_t k = 0; k < 3 && sites[k].valid(); ++k) {
    const Spoke next = links_[c].next[k], previous = links_[c].previous[k];
    (previous.valid() ? links_[previous.circle()].next[previous.place()] : first_[sites[k]]) = next;
    if (next.valid()) links_[next.circle()].previous[next.place()] = previous;
  }
}

void EmptyCircles::enlist(CircleId c) {
  ensure(c.value < 1 << 29, "empty circles: too many");
  const std::array<SiteId, 3>& sites = circles_[c].sites;
  for (std::size_t k = 0; k < 3 && sites[k].valid(); ++k) {
    if (sites[k].index() >= first_.size()) first_.resize(sites[k].index() + 1);
    Spoke& first = first_[sites[k]];
    links_[c].next[k] = first;
    links_[c].previous[k] = Spoke();
    if (first.valid()) links_[first.circle()].previous[first.place()] = Spoke(c, k);
    first = Spoke(c, k);
  }
}

std::size_t EmptyCircles::check() const {
  std::size_t listed = 0;
  for (SiteId s(0); s.index() < first_.size(); s = SiteId(s.value + 1)) {
    Spoke before;
    for (Spoke at = first_[s]; at.valid(); before = at, at = links_[at.circle()].next[at.place()]) {
      ensure(circles_[at.circle()].sites[at.place()] == s,
             "empty circles: one is listed at a site that it does not touch");
      const Spoke back = links_[at.circle()].previous[at.place()];
      ensure(back.valid() == before.valid() &&
                 (!back.valid() || (back.circle() == before.circle() && back.place() == before.place())),
             "empty circles: the links of a list disagree");
      listed += at.place() == 0;
    }
  }
  return listed;
}

}  // namespace geom
