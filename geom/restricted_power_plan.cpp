// The removal of a site, planned: what it would bring is told, nothing is changed.
//
// Who wants to know the largest empty circle does not need the whole division of the cell. On a facet where p has at
// most one neighbour (where facets are smaller than cells, most are so) the division can wait: the power to one heir
// at the corners of p's fragment bounds that of all circles there. Those fragments whose bound is less than a circle
// that is known already are divided only when p's new place is known; and then most need not be divided at all.

#include <algorithm>
#include <array>
#include <limits>

#include "geom/restricted_power.h"

namespace geom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

std::optional<RestrictedPower::Plan> RestrictedPower::plan_removal(SiteId p) {
  if (types_ == CornerTypes::all || !vacate(p) || division_.heirs().empty()) return {};
  defer_simple();
  do divide_where_largest(p);
  while (add_missing_heirs(p, neighbours_));
  strangers_ = candidates_;
  return present_plan(p);
}

RestrictedPower::Plan RestrictedPower::complete_plan(SiteId p) {
  if (!deferred_.empty()) divide_vacancy(p);
  heirs_of_plan_.clear();
  for (const CellDivision::Share& share : division_.shares()) heirs_of_plan_.push_back(share.polygon.owner);
  std::ranges::sort(heirs_of_plan_);
  heirs_of_plan_.erase(std::unique(heirs_of_plan_.begin(), heirs_of_plan_.end()), heirs_of_plan_.end());
  Plan plan = present_plan(p);
  plan.heirs = heirs_of_plan_;
  return plan;
}

RestrictedPower::Plan RestrictedPower::present_plan(SiteId p) {
  list_planned_circles(p);
  double complete_above = -infinity;
  for (const Simple& simple : deferred_) complete_above = std::max(complete_above, simple.bound);
  return {division_.heirs(), planned_circles_, std::max(reach(p), division_.max_radius2()), complete_above};
}

/// Sorts the vacated fragments: those with several neighbours are divided in any case, the others perhaps.
void RestrictedPower::defer_simple() {
  at_once_.clear();
  deferred_.clear();
  std::array<PolygonCorner, 3> buffer;
  for (std::size_t i = 0; i < vacated_.size(); ++i) {
    const std::span<const PolygonCorner> corners = store_.corners(vacated_[i], buffer);
    SiteId neighbour;
    std::size_t borders = 0;
    for (const PolygonCorner& corner : corners) {
      if (!corner.edge.is_site()) continue;
      neighbour = corner.edge.site();
      ++borders;
    }
    if (borders > 1) {
      at_once_.push_back(i);
    } else {
      const FacetId t = store_.facet(vacated_[i]);
      const SiteId near = neighbour.valid() ? neighbour : nearest_heir(clipper_.middle(t));
      deferred_.push_back({clipper_.bound_circle(t, near, corners), i, neighbour});
    }
  }
}

SiteId RestrictedPower::nearest_heir(const Vec3& location) const {
  SiteId nearest;
  double least = infinity;
  for (const SiteId h : division_.heirs()) {
    const double value = power(location, sites_[h]);
    if (nearest.valid() && value >= least) continue;
    nearest = h;
    least = value;
  }
  return nearest;
}

/// Divides what cannot wait and, of what is deferred, all that might hold a larger circle than what is divided.
void RestrictedPower::divide_where_largest(SiteId p) {
  division_.start();
  double largest = -infinity;
  std::size_t seen = 0;
  const auto divide = [&](std::size_t vacated) {
    division_.divide(vacated);
    for (; seen < division_.corners().size(); ++seen) {
      const CellCorner& corner = division_.corners()[seen];
      if (brings_circle(corner, p))
        largest = std::max(largest, power(corner.point.position, sites_[corner.owner]));
    }
  };
  for (const std::size_t i : at_once_) divide(i);
  while (!deferred_.empty()) {
    const auto next = std::ranges::max_element(deferred_, {}, &Simple::bound);
    if (next->bound < largest) return;
    at_once_.push_back(next->vacated);
    *next = deferred_.back();
    deferred_.pop_back();
    divide(at_once_.back());
  }
}

/// Is that corner of the division of p's cell an empty circle without p?
bool RestrictedPower::brings_circle(const CellCorner& corner, SiteId p) {
  const EdgeLabel border = EdgeLabel::bisector(p);
  return corner.before.is_site() && corner.after.is_site() && corner.before != border &&
         corner.after != border;
}

void RestrictedPower::list_planned_circles(SiteId p) {
  planned_circles_.clear();
  for (const CellCorner& corner : division_.corners()) {
    if (!brings_circle(corner, p)) continue;
    EmptyCircle circle;
    circle.facet = corner.facet;
    circle.sites = {corner.owner, corner.before.site(), corner.after.site()};
    std::ranges::sort(circle.sites);
    center_circle(circle, corner.point.position);
    planned_circles_.push_back(circle);
  }
}

const RestrictedPower::Change& RestrictedPower::carry_out_removal(SiteId p) {
  complete_plan(p);
  begin(p);
  carry_out_division(p);
  finish();
  return change_;
}

// --- what is left to divide when p's new place is known ------------------------------------------

// On most facets that were deferred p will win all that it had, but for what its only neighbour there can take. Then
// all is that neighbour's, for p to win it from there; or p's, if there is no neighbour. On the other facets its old
// cell is divided as usual.
//
// No others need be asked than the heirs and the strangers: these are all that may be as near as the largest circle
// is large, and that is larger than any bound of what is deferred. Corners before the first new one were asked about
// when the strangers were found.
void RestrictedPower::settle_deferred(SiteId p, const WeightedPoint3& point) {
  if (deferred_.empty()) return;
  contenders_.clear();
  const auto add = [&](SiteId s) { contenders_.push_back({s, bisector(point, sites_[s], extent_), false}); };
  for (const SiteId h : division_.heirs()) add(h);
  for (const SiteId s : strangers_) add(s);
  const std::size_t first_corner = division_.corners().size();
  for (const auto& [bound, vacated, neighbour] : deferred_) {
    if (!wins_over_all_but(neighbour, vacated_[vacated]))
      division_.divide(vacated);
    else if (neighbour.valid())
      division_.leave_to(neighbour, vacated);
    else
      assembly_.win_on(store_.facet(vacated_[vacated]));
  }
  deferred_.clear();
  if (std::ranges::any_of(strangers_, [&](SiteId j) { return division_.is_missing(j, first_corner); }))
    divide_vacancy(p);
}

/// Is p, at its new place, surely nearer than all of its rivals but that one everywhere on this fragment?
bool RestrictedPower::wins_over_all_but(SiteId neighbour, FragmentId vacated) const {
  const FacetId t = store_.facet(vacated);
  const std::span<const PolygonCorner> corners = store_.corners(vacated);
  return std::ranges::all_of(contenders_, [&](const Rival& rival) {
    const Bisector& b = rival.bisector;
    return rival.site == neighbour || clipper_.compare_on_facet(t, b) == Clip::untouched ||
           (!corners.empty() && std::ranges::all_of(corners, [&](const PolygonCorner& c) {
             return b(c.point.position) > b.error + b.length * c.point.tolerance;
           }));
  });
}

}  // namespace geom
