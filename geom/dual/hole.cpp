#include "geom/dual/hole.h"

#include <algorithm>
#include <cmath>

namespace geom {
namespace {

using margin::bend;
using margin::more;

constexpr double tight = 1.2;  // a bound of the power in the cell, to that at its corners

}  // namespace

bool Hole::plan() {
  around_.see_rim();
  around_.leeway = leeways_.find();
  around_.on_sheet = !around_.leeway && chart_star();
  if (!triangles_.fill() || !(prove_with_leeway() || prove())) return false;
  is_on_sheet_ = around_.on_sheet || around_.leeway;
  circles_.clear();
  for (const Triangle& triangle : triangles()) {
    circles_.push_back(around_.state.corners.circle_at(triangle.meeting));
    max_radius2_ = std::max(max_radius2_, circles_.back().radius2);
  }
  return true;
}

bool Hole::make_exact() {
  if (!is_on_sheet_) return true;  // it was traced
  const double bound = max_radius2_;
  const bool is_certain = trace();
  around_.flood.clear();
  if (!is_certain) return max_radius2_ = bound, false;
  for (const EmptyCircle& circle : circles_) max_radius2_ = std::max(max_radius2_, circle.radius2);
  return true;
}

void Hole::cancel() {
  const DualState& state = around_.state;
  if (state.paper) state.paper->insert(around_.p, around_.site(), around_.rim[0]);
}

/// Puts the rim and p into a chart, if the surface is a sheet there.
bool Hole::chart_star() {
  const DualState& state = around_.state;
  const SiteId p = around_.p;
  double range = state.reach[p];  // that the new cell will do with, too
  for (const SiteId r : around_.rim.sites()) range = std::max(range, state.reach[r]);
  const Sheet* sheet = around_.sheet_around(state.distance_at(range, p));
  if (!sheet) return false;
  around_.chart_sites(*sheet);
  return true;
}

/// Those across which two triangles lie, and those from the rim inwards.
void Hole::find_edges() {
  edges_.clear();
  for (std::size_t i = 0; i < triangles().size(); ++i)
    for (std::size_t e = 0; e < 3; ++e) {
      const Triangle& triangle = triangles()[i];
      if (triangle.beyond[e] < static_cast<int>(i))
        edges_.push_back({triangle.corners[e == 2 ? 0 : e + 1], triangle.corners[e == 0 ? 2 : e - 1]});
    }
}

bool Hole::is_chart_simple() const {
  const DualState& state = around_.state;
  const double known = state.distance_at(state.reach[around_.p], around_.p);
  return around_.chart.is_simple(around_.rim.size(), edges_, known);
}

/// The same as prove(). Without success the leeway is forgotten.
bool Hole::prove_with_leeway() {
  if (!around_.leeway) return false;
  const DualState& state = around_.state;
  const WeightedPoint3& site = around_.site();
  const Rim& rim = around_.rim;
  steepest_ = around_.leeway->steepest;
  reach_ = state.reach[around_.p];
  const double room = around_.room_around(site.position) / margin::more;
  if (state.distance_at(reach_, around_.p) > room) {
    double own2 = 0;
    for (int j = 0; j < rim.size(); ++j) {
      const EmptyCircle &from = state.circles[rim.inner(rim.previous(j))], &to = state.circles[rim.inner(j)];
      const TracedEdge arc{from.facet, to.facet, from.center, to.center};
      own2 = std::max(own2, around_.farthest2_with_leeway(j, arc, room));
    }
    reach_ = std::min(reach_, own2 - site.weight);
  }
  const double own = state.distance_at(reach_, around_.p);
  max_radius2_ = std::max(reach_, around_.leeway->power);
  const auto is_proven = [&](const Triangle& t) {
    return t.values.squaredNorm() <= own * own &&
           around_.are_kept_beyond(t.point, around_.site(t.corners[0]));
  };
  if (own <= room && std::ranges::all_of(triangles(), is_proven)) return true;
  around_.leeway = nullptr;
  around_.on_sheet = chart_star();
  return false;
}

/// Sets reach_ and max_radius2_ but for the circles.
bool Hole::prove() {
  const DualState& state = around_.state;
  const SiteId p = around_.p;
  if (state.paper) state.paper->remove(p);
  around_.flood.clear();
  reach_ = state.reach[p];
  if (around_.on_sheet) find_edges();
  around_.on_sheet = around_.on_sheet && is_chart_simple() && bound_on_sheet();
  if (around_.on_sheet) {
    if (!has_no_stranger()) return cancel(), false;
    const Surroundings::Division division{edges_, 0, around_.rim.size()};
    if (around_.leaves_strangers_out(division, state.distance_at(reach_, p))) return true;
    around_.on_sheet = false;
  }
  if (trace() && has_no_stranger()) return true;
  cancel();
  return false;
}

/// Sets reach_ from the edges of the cell, if it is not tight as it is known; max_radius2_ and range_ from
/// the rim.
bool Hole::bound_on_sheet() {
  const WeightedPoint3& site = around_.site();
  const Rim& rim = around_.rim;
  const DualState& state = around_.state;
  const auto corner = [&](int j) -> Vec3 { return state.circles[rim.inner(j)].center - site.position; };
  const auto facet = [&](int j) { return state.circles[rim.inner(j)].facet; };
  double corner2 = 0, own2 = 0;
  for (int j = 0; j < rim.size(); ++j) corner2 = std::max(corner2, corner(j).squaredNorm());
  steepest_ = around_.chart.steepest(edges_);
  if (reach_ + site.weight > tight * corner2) {
    const double stretch = farthest_on_edge(1, infinity, around_.chart.steepest(around_.spokes));
    const bool is_flat = stretch <= margin::stretch;
    if (is_flat) own2 = around_.with_tolerance(corner2 * stretch * stretch);
    for (int j = 0; !is_flat && j < rim.size(); ++j) {
      const int i = rim.previous(j);
      const Surroundings::Edge arc{around_.self, j, facet(i), facet(j), corner(i), corner(j)};
      own2 = std::max(own2, around_.with_tolerance(around_.farthest2(arc, bend * corner2)));
    }
    reach_ = std::min(reach_, own2 - site.weight);
  }
  const double own = state.distance_at(reach_, around_.p);
  if (!around_.sheet.covers(site.position, own)) return false;
  for (const Triangle& triangle : triangles())
    if (!(triangle.values.squaredNorm() <= own * own)) return false;
  const Chart::Gain most = around_.chart.most_gain(rim.size(), own, site.weight, state.search.heaviest());
  max_radius2_ = std::max(reach_, most.power);
  range_ = most.range;
  return range_ < infinity;
}

/// Sets reach_ and max_radius2_ but for the circles, from all facets of the cell.
bool Hole::trace() {
  const Rim& rim = around_.rim;
  const DualState& state = around_.state;
  Flood& flood = around_.flood;
  facets_.clear();
  for (const CircleId c : rim.inside()) facets_.push_back(state.circles[c].facet);
  if (!flood.trace(facets_, true)) return false;
  for (const Triangle& triangle : triangles()) {
    const auto& [a, b, c] = triangle.corners;
    if (!flood.add_end(triangle.facet(), a, b) || !flood.add_end(triangle.facet(), b, c) ||
        !flood.add_end(triangle.facet(), c, a))
      return false;
  }
  for (int j = 0; j < rim.size(); ++j)
    if (!flood.add_end(facets_[static_cast<std::size_t>(j)], j, rim.next(j))) return false;
  if (!flood.is_complete()) return false;
  const WeightedPoint3& site = around_.site();
  double radius2 = flood.radius2();
  for (const CircleId c : rim.inside())
    radius2 = std::max(radius2, around_.distance2(around_.on_surface(state.circles[c]), site));
  reach_ = radius2 * more - site.weight;
  max_radius2_ = reach_;
  for (const Triangle& triangle : triangles())
    max_radius2_ =
        std::max(max_radius2_, around_.power_at(triangle.point, around_.site(triangle.corners[0])));
  for (const Flood::Corner& corner : flood.corners()) {
    const double weight = around_.site(corner.site).weight;
    const double far =
        std::sqrt(std::max(0.0, around_.frame.power(corner.at, corner.site) + weight)) + corner.off;
    max_radius2_ = std::max(max_radius2_, far * far * more - weight);
  }
  return true;
}

/// Are the sites beyond the rim farther at all circles, and at the corners of the flood?
bool Hole::has_no_stranger() {
  const WeightedPoint3& site = around_.site();
  Strangers& strangers = around_.strangers;
  const double radius = around_.state.distance_at(reach_, around_.p);
  const Vacancy hole{around_.p, site.position, radius, max_radius2_ + 1e-9 * std::abs(max_radius2_)};
  strangers.find_heirs(hole, around_.on_sheet ? range_ : infinity);
  const Strangers::Ball ball{Vec3(0, 0, 0), radius, around_.on_sheet || around_.is_flood_level()};
  strangers.keep_near(around_.frame, around_.p, around_.rim.sites(), ball, Frame::nobody);
  if (strangers.kept().empty()) return true;
  const auto is_empty = [&](const SurfacePoint& z, int nearest) {
    return strangers.are_beyond(z, around_.site(nearest));
  };
  return std::ranges::all_of(triangles(),
                             [&](const Triangle& t) { return is_empty(t.point, t.corners[0]); }) &&
         std::ranges::all_of(around_.flood.corners(), [&](const Flood::Corner& corner) {
           return is_empty(around_.on_surface(corner), corner.site);
         });
}

/// That is bounded by the old border, which the rim reached before, and the new edges. Across the side from a
/// to b of a triangle the edge has b on its left.
void Hole::raise_reaches() const {
  DualState& state = around_.state;
  const Rim& rim = around_.rim;
  if (!is_on_sheet_) {
    for (const SiteId r : rim.sites()) state.reach.raise(r, max_radius2_);
    return;
  }
  for (std::size_t i = 0; i < triangles().size(); ++i)
    for (std::size_t e = 0; e < 3; ++e) {
      const Triangle& triangle = triangles()[i];
      const int beyond = triangle.beyond[e];
      if (beyond > static_cast<int>(i)) continue;
      const SiteId a = rim[triangle.corners[e == 2 ? 0 : e + 1]],
                   b = rim[triangle.corners[e == 0 ? 2 : e - 1]];
      TracedEdge edge{triangle.facet(), FacetId(), triangle.point.position, Vec3(0, 0, 0)};
      if (beyond >= 0) {
        edge.to = triangles()[static_cast<std::size_t>(beyond)].facet();
        edge.end = triangles()[static_cast<std::size_t>(beyond)].point.position;
      } else {
        const EmptyCircle& corner = state.circles[rim.inner(-1 - beyond)];
        edge.to = corner.facet;
        edge.end = corner.center;
      }
      const WeightedPoint3 &left = state.sites[b], &right = state.sites[a];
      double power = around_.power_along(left, edge.start, edge.end, steepest_);  // to both
      if (!(power < infinity))
        power = around_.with_tolerance(extent_of_edge(state.mesh, left, right, edge).far2) - left.weight;
      power = std::min(power, max_radius2_);
      state.reach.raise(a, power);
      state.reach.raise(b, power);
    }
}

}  // namespace geom
