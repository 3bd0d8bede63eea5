#include "geom/dual/cell_proof.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geom {

using margin::ampler;
using margin::bend;
using margin::more;
using margin::widest;

bool CellProof::prove_new(const Place& place) {
  if (!place.home.valid() || !find_corners()) return false;
  NeighbourOracle* const paper = around_.state.paper;
  if (paper) paper->insert(around_.p, around_.site(), around_.rim[0]);
  if (prove_inserted(place)) return true;
  if (paper) paper->remove(around_.p);
  return false;
}

bool CellProof::prove_inserted(const Place& place) {
  if (may_beat_unreached()) return false;
  if (around_.leeway) {
    if (prove_with_leeway(place.old)) return true;
    around_.leeway = nullptr;
    if (beats_outer_circle()) return false;
  }
  DualState& state = around_.state;
  const Vec3& position = around_.site().position;
  reach_ = power_bound_at_corners();
  const double own = state.distance_at(reach_, around_.p);
  if (!has_no_stranger(ampler * own, are_corners_level())) return false;
  const double all = state.distance_at(std::max(reach_, state.reach.largest()), around_.p);
  const bool is_all_near = around_.on_sheet && around_.sheet.covers(position, all);
  far_rivals_.clear();
  if (!is_all_near) find_far_rivals(own);
  const double farthest = far_rivals_.empty() ? own : far_rivals_.front().distance;
  double least = farthest <= widest * own ? farthest : own;
  around_.on_sheet = around_.on_sheet && around_.sheet.covers(position, least);
  if (!around_.on_sheet)
    least = std::max(least, place.least_distance);  // the hole was not proven on that sheet
  if (around_.chart_around(least)) {
    const double near = around_.sheet.distance_from(position);
    around_.on_sheet = distance_to_search(near, place.old) <= near && enclose_on_sheet(least);
  }
  if (around_.on_sheet) return true;
  if (!trace(place.home)) return false;
  if (is_all_near) find_far_rivals(own);
  const double near = std::max({own, place.least_distance, state.distance_at(reach_, around_.p)});
  return single_.is_all(reach_, distance_to_search(near, place.old));
}

/// The hole was proven with this leeway.
bool CellProof::prove_with_leeway(const WeightedPoint3& old) {
  DualState& state = around_.state;
  const Rim& rim = around_.rim;
  const WeightedPoint3& site = around_.site();
  const double room = around_.room_around(site.position);
  if (!around_.leeway->allows(site.position)) return false;
  double own2 = 0;
  arcs_.clear();
  const double corner2 = power_bound_at_corners() + site.weight;
  const double stretch = farthest_on_edge(1, infinity, around_.leeway->steepest);
  if (stretch <= margin::stretch) {
    own2 = corner2 * stretch * stretch;
    arcs_.assign(static_cast<std::size_t>(rim.size()), own2 - site.weight);
  }
  for (int j = 0; stretch > margin::stretch && j < rim.size(); ++j) {
    const Corner &from = corners_[static_cast<std::size_t>(rim.previous(j))],
                 &to = corners_[static_cast<std::size_t>(j)];
    const double far2 = around_.farthest2_with_leeway(
        j, {from.facet, to.facet, from.point.position, to.point.position}, room / margin::more);
    arcs_.push_back(far2 - site.weight);
    own2 = std::max(own2, far2);
  }
  reach_ = own2 - site.weight;
  const double own = state.distance_at(reach_, around_.p);
  const auto is_proven = [&](const Corner& corner) { return around_.are_kept_beyond(corner.point, site); };
  if (!(own <= room) || !around_.has_one_component(own) || !std::ranges::all_of(corners_, is_proven))
    return false;
  const double near = around_.leeway->near;
  if (state.distance_at(std::max(reach_, state.reach.largest()), around_.p) > near) {
    find_far_rivals(std::max(near, own));  // what others lose within `near` hangs together with the rest
    if (distance_to_search(near, old) > near) return false;
  }
  return around_.on_sheet = true;
}

bool CellProof::prove_present() {
  const DualState& state = around_.state;
  const SiteId p = around_.p;
  around_.see_rim();
  corners_.clear();
  for (const CircleId c : around_.rim.inside())
    corners_.push_back({state.circles[c].facet, around_.on_surface(state.circles[c])});
  const double known = state.distance_at(state.reach[p], p);
  reach_ = power_bound_at_corners();
  if (!has_no_stranger(ampler * state.distance_at(reach_, p), are_corners_level())) return false;
  around_.on_sheet = known <= widest * state.distance_at(reach_, p) && around_.chart_around(known) &&
                     enclose_on_sheet(known);
  return around_.on_sheet || (trace(state.home[p]) && single_.is_all(reach_, known));
}

/// Of the new cell of p, empty but for strangers. At each p and two sites are equally near, so those two are
/// not certainly farther; nobody else may be that.
bool CellProof::find_corners() {
  const Rim& rim = around_.rim;
  const DualState& state = around_.state;
  const int p = around_.self;
  if (p == Frame::none) around_.see_rim();
  corners_.resize(static_cast<std::size_t>(rim.size()));
  const int most_near = p == Frame::none ? 2 : 3;  // p is counted if it is in the frame
  Frame::Values values;
  for (int j = 0; j < rim.size(); ++j) {
    const AxisPlace place =
        around_.meeting({around_.p, rim[j], rim[rim.next(j)]}, state.circles[rim.inner(j)].facet);
    if (!place.facet.valid()) return false;
    Corner& corner = corners_[static_cast<std::size_t>(j)];
    corner = {place.facet, around_.on_surface(place.facet, place.point)};
    around_.frame.evaluate(around_.frame.place_of(corner.point), corner.point.off, values);
    if (values.num_not_farther(p) > most_near) return false;
  }
  return true;
}

/// Does p beat a circle around the rim, perhaps?
bool CellProof::beats_outer_circle() const {
  return !std::ranges::all_of(around_.rim.outer_circles(), [&](CircleId c) {
    return around_.state.lead_at(around_.state.circles[c], around_.site()).positive();
  });
}

/// May p beat circles that are not reached, or hide a site that has none? That would be an irregular one.
bool CellProof::may_beat_unreached() {
  DualState& state = around_.state;
  if (state.shapes.not_regular().empty()) return false;
  const WeightedPoint3& point = around_.site();
  const std::span<const CircleId> reached = around_.rim.inside();
  suspects_.clear();
  state.irregular_rivals(around_.p, suspects_);
  return std::ranges::any_of(suspects_, [&](SiteId s) {
    const double far = state.distance_at(state.reach[s], s) + state.distance_at(state.reach[s], around_.p);
    if (s == around_.p || (state.sites[s].position - point.position).squaredNorm() > far * far * more)
      return false;
    const std::span<const CircleId> circles = state.circles.of_site(s);
    if (circles.empty()) return !keeps_its_place(s);
    return std::ranges::any_of(circles, [&](CircleId c) {
      return std::ranges::find(reached, c) == reached.end() &&
             !state.lead_at(state.circles[c], point).positive();
    });
  });
}

/// Is s surely the nearest to its own place still? p is asked by itself, for the search looks for it where it
/// was. Who is next has the least power of all that the search has looked at, p with its power where it is
/// now: if that is p, those not looked at have more than p, else than who is next.
bool CellProof::keeps_its_place(SiteId s) const {
  const DualState& state = around_.state;
  const WeightedPoint3& site = state.sites[s];
  const SiteId next = state.nearest({site.position, site.level}, s).site;
  return next.valid() && state.leads_at_its_place(s, around_.site()) &&
         state.leads_at_its_place(s, state.sites[next]);
}

/// Of p at the corners of its cell. Sets far2_.
double CellProof::power_bound_at_corners() {
  const WeightedPoint3& site = around_.site();
  double most = 0;
  far2_.clear();
  for (const Corner& corner : corners_) {
    far2_.push_back(around_.distance2(corner.point, site));
    most = std::max(most, far2_.back());
  }
  return around_.with_tolerance(most) - site.weight;
}

/// Those who may lose something farther from p than that, the farthest first.
void CellProof::find_far_rivals(double distance) {
  const DualState& state = around_.state;
  far_rivals_.clear();
  suspects_.clear();
  around_.strangers.find_rivals_beyond(distance * distance - around_.site().weight, around_.p, suspects_);
  for (const SiteId s : suspects_) far_rivals_.push_back({state.distance_at(state.reach[s], around_.p), s});
  std::ranges::sort(far_rivals_,
                    [](const FarRival& a, const FarRival& b) { return a.distance > b.distance; });
}

/// All that p has is known if its cell is, within that distance: not less than `near`, for which it is so of
/// what hangs together with a circle inside the rim.
double CellProof::distance_to_search(double near, const WeightedPoint3& old) {
  for (const FarRival& rival : far_rivals_) {
    if (rival.distance <= near) break;
    if (!losses_.hang_together(rival.site, {around_.p, around_.site(), old}, around_.rim.inside()))
      return rival.distance;
  }
  return near;
}

/// Is the cell of p what its corners say (chart.h), and all that p has where the chart is, at least within
/// that distance? reach_ is that of the corners; sets it and arcs_.
bool CellProof::enclose_on_sheet(double distance) {
  const Rim& rim = around_.rim;
  const WeightedPoint3& site = around_.site();
  const Vec3& origin = around_.frame.origin().position;
  const double stretch = farthest_on_edge(1, infinity, around_.chart.steepest(around_.spokes));
  const double enough = bend * (reach_ + site.weight);  // that at the corners
  double own2 = 0;
  arcs_.clear();
  for (int j = 0; j < rim.size(); ++j) {
    const auto from = static_cast<std::size_t>(rim.previous(j)), to = static_cast<std::size_t>(j);
    double far2 = std::max(far2_[from], far2_[to]) * stretch * stretch;
    if (stretch > margin::stretch) {
      const Corner &start = corners_[from], &end = corners_[to];
      const Surroundings::Edge arc{around_.self,
                                   j,
                                   start.facet,
                                   end.facet,
                                   start.point.position - origin,
                                   end.point.position - origin};
      far2 = around_.farthest2(arc, enough);
    }
    far2 = around_.with_tolerance(far2);
    arcs_.push_back(far2 - site.weight);
    own2 = std::max(own2, far2);
  }
  const Vec3 middle = site.position - origin;
  const double own = std::sqrt(own2) * more, radius = own + middle.norm();
  if (!around_.sheet.covers(site.position, std::max(distance, own)) ||
      !around_.chart.is_simple_with(rim.size(), radius))
    return false;
  link_.clear();
  for (int j = 0; j < rim.size(); ++j)
    link_.push_back({around_.frame.offset(j) - middle, Frame::seen(around_.site(j), site).c});
  if (!Sheets::has_one_component(around_.sheet, own, link_)) return false;
  reach_ = own2 - site.weight;
  return (own <= kept_radius_ || has_no_stranger(own, true)) &&
         around_.leaves_strangers_out({around_.spokes, rim.size(), 1}, radius);
}

/// Sets reach_. `home`: a facet with the location of p.
bool CellProof::trace(FacetId home) {
  Flood& flood = around_.flood;
  const Rim& rim = around_.rim;
  around_.see_rim();
  facets_.clear();
  for (const Corner& corner : corners_) facets_.push_back(corner.facet);
  if (!flood.trace(facets_, false) || !flood.facets().has(home)) return false;
  for (int j = 0; j < rim.size(); ++j) {
    const FacetId t = facets_[static_cast<std::size_t>(j)];
    if (!flood.add_end(t, j, Frame::none) || !flood.add_end(t, rim.next(j), Frame::none)) return false;
  }
  if (!flood.is_complete()) return false;
  const WeightedPoint3& site = around_.site();
  double radius2 = flood.radius2();
  for (const Corner& corner : corners_) {
    const double far = std::sqrt(around_.distance2(corner.point, site)) + corner.point.off;
    radius2 = std::max(radius2, far * far);
  }
  reach_ = radius2 * more - site.weight;
  return has_no_stranger(std::sqrt(radius2 * more), around_.is_flood_level());
}

/// Are the corners in facets of the level that all sites of the frame have?
bool CellProof::are_corners_level() const {
  return !around_.state.has_levels ||
         std::ranges::all_of(corners_, [&](const Corner& corner) { return around_.is_level(corner.facet); });
}

/// Are the sites beyond the rim farther at all corners of the cell, and at those of the flood? The cell is in
/// that ball, and has one level or not.
bool CellProof::has_no_stranger(double radius, bool is_level) {
  const WeightedPoint3& site = around_.site();
  const Frame& frame = around_.frame;
  Strangers& strangers = around_.strangers;
  kept_radius_ = radius;
  strangers.find_rivals(around_.p, site.position, radius);
  const Strangers::Ball ball{frame.place_of({site.position, site.level, 0}), radius, is_level};
  strangers.keep_near(frame, around_.p, around_.rim.sites(), ball, around_.self);
  if (strangers.kept().empty()) return true;
  const auto is_p_nearest = [&](const SurfacePoint& z) { return strangers.are_beyond(z, site); };
  return std::ranges::all_of(corners_, [&](const Corner& c) { return is_p_nearest(c.point); }) &&
         std::ranges::all_of(around_.flood.corners(),
                             [&](const Flood::Corner& c) { return is_p_nearest(around_.on_surface(c)); });
}

}  // namespace geom
