#include "geom/dual/rim.h"

#include <algorithm>

namespace geom {

bool Rim::open_star(const DualState& state, SiteId p) {
  const std::span<const CircleId> own = state.circles.of_site(p);
  const std::size_t n = own.size();
  clear();
  if (n < 3 || n > most) return false;
  CircleId c = own.front();
  SiteId first = SiteId();  // of the next circle
  for (std::size_t j = 0; j < n; ++j) {
    const EmptyCircle& circle = state.circles[c];
    const std::size_t i = circle.index_of(p), after = circle.after(i);
    const SiteId site = circle.sites[after];
    if (j > 0 && site != first) return false;
    first = circle.sites[3 - i - after];
    bool is_new = true;
    for (std::size_t k = 0; k < j; ++k) is_new &= sites_[k] != site;
    if (!is_new || !circle.beyond[i].valid()) return false;
    sites_[j] = site;
    inner_[j] = inside_[j] = c;
    outer_[j] = circle.beyond[i];
    c = circle.beyond[after];
    if (!c.valid() || (c == own.front()) != (j + 1 == n)) return false;
  }
  size_ = static_cast<int>(n);
  num_inside_ = n;
  return true;
}

bool Rim::find_conflict(const DualState& state, const WeightedPoint3& point, CircleId first) {
  std::array<Edge, 3 * most> edges;
  std::size_t num_edges = 0;
  clear();
  inside_[num_inside_++] = first;
  if (!state.lead_at(state.circles[first], point).negative()) return false;
  for (std::size_t n = 0; n < num_inside_; ++n) {
    const EmptyCircle circle = state.circles[inside_[n]];
    for (std::size_t i = 0; i < 3; ++i) {
      const CircleId other = circle.beyond[i];
      if (!other.valid()) return false;
      if (std::ranges::find(inside(), other) != inside().end()) continue;
      const Sure found = state.lead_at(state.circles[other], point);
      if (!found.certain()) return false;
      if (found.value < 0) {
        if (num_inside_ == inside_.size()) return false;
        inside_[num_inside_++] = other;
      } else {
        if (num_edges == edges.size()) return false;
        edges[num_edges++] = {circle.sites[circle.after(i)], circle.sites[circle.before(i)], other,
                              inside_[n]};
      }
    }
  }
  if (num_edges != num_inside_ + 2 || num_edges > most) return false;
  return put_in_order({edges.data(), num_edges});
}

/// Each edge after the one that ends where it starts; false if that is not one cycle of distinct sites.
bool Rim::put_in_order(std::span<const Edge> edges) {
  auto edge = edges.begin();
  for (std::size_t j = 0; j < edges.size(); ++j) {
    if (std::ranges::find(sites(), edge->from) != sites().end()) return false;
    sites_[j] = edge->from;
    outer_[j] = edge->outer;
    inner_[j] = edge->inner;
    ++size_;
    edge = std::ranges::find(edges, edge->to, &Edge::from);
    if (edge == edges.end()) return false;
  }
  return edge == edges.begin();
}

}  // namespace geom
