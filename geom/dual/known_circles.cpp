#include "geom/dual/known_circles.h"

#include <algorithm>

#include "geom/check.h"

namespace geom {
namespace {

bool is_there(const EmptyCircle& circle, const EmptyCircles& circles) {
  return std::ranges::any_of(circles.of_site(circle.sites[0]), [&](CircleId c) {
    return circles[c].sites == circle.sites && circles[c].facet == circle.facet;
  });
}

/// Each edge of the diagram beside that cell ends at two of its circles.
void join_around(SiteId p, EmptyCircles& circles) {
  for (const CircleId c : circles.of_site(p)) {
    const EmptyCircle& circle = circles[c];
    const std::size_t i = circle.index_of(p), after = circle.after(i);
    const SiteId beside = circle.sites[circle.before(i)];  // the edge that `after` is opposite to
    CircleId other;
    for (const CircleId d : circles.of_site(p))
      if (d != c && circles[d].touches(beside)) {
        ensure(!other.valid(), "known circles: an edge has three ends");
        other = d;
      }
    ensure(other.valid(), "known circles: an edge has one end");
    circles.set_beyond(c, after, other);
    circles.set_beyond(other, circles[other].opposite(p, beside), c);
  }
}

}  // namespace

void create_known(const KnownDiagram& known, DualState& state, DualChange& change) {
  if (known.circles.empty()) return;
  for (const EmptyCircle& circle : known.circles) {
    if (!known.has_circles_of_any(circle) || is_there(circle, state.circles)) continue;
    EmptyCircle alone = circle;
    alone.beyond.fill(CircleId());
    change.circles_created.push_back(state.circles.create(alone));
  }
  for (SiteId s(0); s.index() < state.sites.size(); s = SiteId(s.value + 1)) {
    if (!known.has_circles_of(s)) continue;
    join_around(s, state.circles);
    state.reach.set(s, known.reaches[s.index()]);
  }
}

std::vector<FacetId> facets_to_divide(const KnownDiagram& known, const DualState& state) {
  std::vector<FacetId> facets(state.facets.order().begin(), state.facets.order().end());
  if (known.circles.empty()) return facets;
  Table<FacetId, char> is_near(state.mesh.num_facets(), 0);
  std::vector<FacetId> near;
  std::size_t left = facets.size();
  for (SiteId s(0); s.index() < state.sites.size() && left > 0; s = SiteId(s.value + 1)) {
    if (known.has_circles_of(s)) continue;
    const WeightedPoint3& site = state.sites[s];
    near.clear();
    state.facets.near({site.position, site.level}, state.distance_at(known.power, s), near);
    for (const FacetId t : near) {
      left -= is_near[t] == 0;
      is_near[t] = 1;
    }
  }
  std::erase_if(facets, [&](FacetId t) { return is_near[t] == 0; });
  return facets;
}

}  // namespace geom
