#include "geom/dual/empty_circles.h"

#include <algorithm>
#include <tuple>

#include "geom/check.h"

namespace geom {

bool circle_before(const EmptyCircle& a, const EmptyCircle& b) {
  return std::tie(a.facet, a.place, a.sites) < std::tie(b.facet, b.place, b.sites);
}

void EmptyCircle::sort_counterclockwise() {
  const auto [a, b, c] = sites;
  clockwise = (a < b) + (b < c) + (c < a) == 1;  // else they ascend twice on the way round
  sites = {std::min({a, b, c}), std::max(std::min(a, b), std::min(std::max(a, b), c)), std::max({a, b, c})};
}

CircleId EmptyCircles::create(const EmptyCircle& circle) {
  CircleId c;
  if (free_.empty()) {
    c = circles_.next_id();
    circles_.push_back(circle);
  } else {
    c = free_.back();
    free_.pop_back();
    circles_[c] = circle;
  }
  for (const SiteId s : circle.sites)
    if (s.valid()) of_site_.push(s, c);
  ++live_;
  return c;
}

void EmptyCircles::erase(CircleId c) {
  for (const SiteId s : circles_[c].sites) {
    if (!s.valid()) break;
    const std::span<const CircleId> list = of_site_[s];
    of_site_.erase(s, static_cast<std::uint32_t>(std::ranges::find(list, c) - list.begin()));
  }
  --live_;
}

void EmptyCircles::reserve(std::size_t num_sites) { circles_.reserve(2 * num_sites + num_sites / 8 + 64); }

void EmptyCircles::check() const {
  std::size_t listed = 0;
  for (SiteId s(0); s.index() < of_site_.num_keys(); s = SiteId(s.value + 1))
    for (const CircleId c : of_site_[s]) {
      const EmptyCircle& circle = circles_[c];
      ensure(circle.touches(s), "empty circles: one is listed at a site that it does not touch");
      listed += circle.sites[0] == s;
      if (!circle.is_triangle()) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        if (!circle.beyond[i].valid()) continue;
        const SiteId a = circle.sites[(i + 1) % 3], b = circle.sites[(i + 2) % 3];
        const EmptyCircle& other = circles_[circle.beyond[i]];
        ensure(other.touches(a) && other.touches(b), "empty circles: two beyond each other share no edge");
        ensure(std::ranges::count(other.beyond, c) > 0, "empty circles: one beyond another does not know it");
        ensure(std::ranges::count(of_site_[a], circle.beyond[i]) == 1,
               "empty circles: an erased one is beyond");
      }
    }
  ensure(listed == live_, "empty circles: listed and present differ in number");
}

}  // namespace geom
