#include "geom/dual/rim.h"

#include <algorithm>
#include <array>

namespace geom {

void Rim::clear() {
  sites_.clear();
  inner_.clear();
  outer_.clear();
  inside_.clear();
}

bool Rim::open_star(const DualState& state, SiteId p) {
  const std::span<const CircleId> own = state.circles.of_site(p);
  const std::size_t n = own.size();
  if (n < 3 || n > most) return false;
  sites_.resize(n);
  inner_.resize(n);
  outer_.resize(n);
  CircleId c = own.front();
  SiteId first = SiteId();  // of the next circle
  for (std::size_t j = 0; j < n; ++j) {
    const EmptyCircle& circle = state.circles[c];
    const std::size_t i = circle.index_of(p);
    const SiteId site = circle.sites[circle.after(i)];
    if (j > 0 && site != first) return false;
    first = circle.sites[circle.before(i)];
    for (std::size_t k = 0; k < j; ++k)
      if (sites_[k] == site) return false;
    if (!circle.beyond[i].valid() || !state.is_level(circle, state.sites[p].level)) return false;
    sites_[j] = site;
    inner_[j] = c;
    outer_[j] = circle.beyond[i];
    c = circle.beyond[circle.after(i)];
    if (!c.valid() || (c == own.front()) != (j + 1 == n)) return false;
  }
  inside_ = inner_;
  return true;
}

bool Rim::find_conflict(const DualState& state, const WeightedPoint3& point, CircleId first) {
  std::array<Edge, 3 * most> edges;
  std::size_t num_edges = 0;
  clear();
  inside_.push_back(first);
  if (!state.lead_at(state.circles[first], point).negative()) return false;
  for (std::size_t n = 0; n < inside_.size(); ++n) {
    const EmptyCircle circle = state.circles[inside_[n]];
    if (!state.is_level(circle, point.level)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      const CircleId other = circle.beyond[i];
      if (!other.valid()) return false;
      if (std::ranges::find(inside_, other) != inside_.end()) continue;
      const Sure found = state.lead_at(state.circles[other], point);
      if (!found.certain()) return false;
      if (found.value < 0) {
        if (inside_.size() == 2 * most) return false;
        inside_.push_back(other);
      } else {
        if (num_edges == edges.size()) return false;
        edges[num_edges++] = {circle.sites[circle.after(i)], circle.sites[circle.before(i)], other,
                              inside_[n]};
      }
    }
  }
  if (num_edges != inside_.size() + 2 || num_edges > most) return false;
  return put_in_order({edges.data(), num_edges});
}

/// Each edge after the one that ends where it starts; false if that is not one cycle of distinct sites.
bool Rim::put_in_order(std::span<const Edge> edges) {
  auto edge = edges.begin();
  for (std::size_t j = 0; j < edges.size(); ++j) {
    if (std::ranges::find(sites_, edge->from) != sites_.end()) return false;
    sites_.push_back(edge->from);
    outer_.push_back(edge->outer);
    inner_.push_back(edge->inner);
    edge = std::ranges::find(edges, edge->to, &Edge::from);
    if (edge == edges.end()) return false;
  }
  return edge == edges.begin();
}

}  // namespace geom
