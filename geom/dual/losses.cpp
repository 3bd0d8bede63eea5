#include "geom/dual/losses.h"

#include <algorithm>

#include "geom/dual/lead.h"

namespace geom {

bool Losses::hang_together(SiteId s, const Newcomer& p, std::span<const CircleId> reached) {
  if (state_.shapes[s] != CellShape::regular) return false;
  const WeightedPoint3& site = state_.sites[s];
  if (site.level != p.point.level) return false;
  const double radius = state_.distance_at(state_.reach[s], s);
  const Sheet* sheet = sheets_.around(s, {site.position, site.level}, radius);
  if (!sheet) return false;
  const auto add = [&](const WeightedPoint3& other) {
    const Frame::Seen seen = Frame::seen(other, site);
    chart_.add(seen.d, seen.c);
  };
  chart_.begin(*sheet);
  add(site);
  add(p.point);
  if (!chart_.is_monotone(0, 1)) return false;
  return std::ranges::all_of(state_.circles.of_site(s), [&](CircleId c) {
    const EmptyCircle& circle = state_.circles[c];
    if (std::ranges::find(reached, c) == reached.end() && !state_.lead_at(circle, p.point).positive())
      return false;
    const SiteId t = circle.sites[circle.after(circle.index_of(s))];
    const WeightedPoint3& neighbour = t == p.id ? p.old : state_.sites[t];
    if (neighbour.level != site.level) return false;
    add(neighbour);
    const bool is_once = chart_.meets_axis_once(0, 1, 2, radius);
    chart_.take_back();
    return is_once;
  });
}

}  // namespace geom
