#include "geom/dual/surroundings.h"

#include <algorithm>

namespace geom {

Surroundings::Surroundings(DualState& whole)
    : state(whole),
      vertices(whole.mesh, frame),
      sheets(whole.mesh, whole.facets, whole.clipper.facets()),
      strangers(whole),
      flood(whole.mesh, vertices) {}

void Surroundings::forget() {
  on_sheet = false;
  leeway = nullptr;
  strangers.forget();
  flood.clear();
}

void Surroundings::see_rim() {
  frame.begin(site());
  vertices.clear();
  self = Frame::none;
  for (const SiteId r : rim.sites()) frame.add(state.sites[r]);
}

void Surroundings::chart_sites(const Sheet& found) {
  sheet = found;
  chart.begin(sheet);
  spokes.clear();
  for (int j = 0; j < rim.size(); ++j) {
    chart.add(frame.offset(j), frame.constant(j));
    spokes.push_back({rim.size(), j});
  }
  chart.add(frame.offset(self), frame.constant(self));
}

bool Surroundings::chart_around(double distance) {
  if (on_sheet && sheet.covers(site().position, distance)) {
    chart.replace(rim.size(), frame.offset(self), frame.constant(self));
    return true;
  }
  const Sheet* found = sheet_around(distance);
  if (found) chart_sites(*found);
  return on_sheet = found;
}

bool Surroundings::is_level(FacetId t) const {
  return frame.is_level() && state.clipper.levels().is_flat_at(t, frame.origin().level);
}

bool Surroundings::is_flood_level() const {
  return !state.has_levels ||
         std::ranges::all_of(flood.facets().items(), [&](const auto& facet) { return is_level(facet.id); });
}

/// Circles may be off: each end by as much, and their distance by twice that.
double Surroundings::power_along(const WeightedPoint3& own, const Vec3& from, const Vec3& to,
                                 double steepest) const {
  const double off = 2 * state.clipper.most_tolerance();
  const double far =
      std::sqrt(std::max((from - own.position).squaredNorm(), (to - own.position).squaredNorm())) + off;
  const double most = farthest_on_edge(far, (to - from).norm() + 2 * off, steepest);
  return most <= margin::stretch * far ? most * most * (1 + 1e-6) - own.weight : infinity;
}

double Surroundings::farthest2_with_leeway(int other, const TracedEdge& edge, double enough) const {
  const double off = 2 * state.clipper.most_tolerance();
  const Vec3& own = site().position;
  const double far =
      std::sqrt(std::max((edge.start - own).squaredNorm(), (edge.end - own).squaredNorm())) + off;
  if (edge.from == edge.to) return far * far * (1 + 1e-6);
  const double most = farthest_on_edge(far, (edge.end - edge.start).norm() + 2 * off, leeway->steepest);
  const double bound = most * most * (1 + 1e-6);
  if (most <= enough) return bound;
  return std::min(bound, with_tolerance(extent_of_edge(state.mesh, site(), site(other), edge).far2));
}

/// As Sheets::has_one_component().
bool Surroundings::has_one_component(double distance) const {
  const double factor = 4 * (1 + 1e-6) * leeway->slope * distance;
  const Vec3& place = site().position;
  for (const SiteId r : rim.sites()) {
    const Vec3 d = state.sites[r].position - place;
    if (!(d.squaredNorm() * (1 - 2e-9) > factor * std::abs(d.dot(leeway->axis)))) return false;
  }
  return true;
}

bool Surroundings::are_kept_beyond(const SurfacePoint& point, const WeightedPoint3& owner) const {
  return std::ranges::all_of(leeway->kept(), [&](const Leeway::Watched& stranger) {
    return leads(owner, state.sites[stranger.site], point);
  });
}

/// Across one edge of the surface tracing is cheaper than the chart's bound.
double Surroundings::farthest2(const Edge& edge, double enough) const {
  const Vec3 d = frame.offset(edge.left);
  if (edge.from == edge.to) return std::max((edge.start - d).squaredNorm(), (edge.end - d).squaredNorm());
  const auto by_tracing = [&] {
    const Vec3& origin = frame.origin().position;
    const WeightedPoint3& left = edge.left == self ? site() : site(edge.left);
    return extent_of_edge(state.mesh, left, site(edge.right),
                          {edge.from, edge.to, edge.start + origin, edge.end + origin})
        .far2;
  };
  const auto is_across = [&](int e) { return state.mesh.across(edge.from, e) == edge.to; };
  const bool is_short = is_across(0) || is_across(1) || is_across(2);
  if (is_short)
    if (const double traced = by_tracing(); traced < infinity) return traced;
  const int left = edge.left == self ? rim.size() : edge.left;
  const double bound = chart.farthest2(left, edge.right, edge.start - d, edge.end - d);
  return is_short || bound <= enough ? bound : std::min(bound, by_tracing());
}

bool Surroundings::leaves_strangers_out(const Division& division, double radius) {
  return std::ranges::all_of(strangers.kept(), [&](const Strangers::Stranger& stranger) {
    const int number = chart.size();
    chart.add(stranger.d, stranger.c);  // on a sheet: its level counts in c
    bool is_out = chart.meets_axes_once(number, division.edges, radius);
    for (int i = 0; is_out && i < division.count; ++i) is_out = chart.is_monotone(division.first + i, number);
    chart.take_back();
    return is_out;
  });
}

AxisPlace Surroundings::meeting_from_inside(const std::array<SiteId, 3>& sites) const {
  AxisPlace place;
  for (const CircleId c : rim.inside()) {
    place = walk_to_axis(state.mesh, state.clipper, sites, state.circles[c].facet);
    if (place.facet.valid()) break;
  }
  return place;
}

}  // namespace geom
