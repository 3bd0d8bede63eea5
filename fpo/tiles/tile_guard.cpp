#include "fpo/tiles/tile_guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fpo {
namespace {

using geom::Vec3;
using geom::WeightedPoint3;

constexpr double likely_clearance = 2.4;  // in radii of a cell: nearer to a cut it can hardly be removed
constexpr double circle_clearance = 3;    // in radii: within, an insertion hardly ever changes more

double root(double x) { return x > 0 ? std::sqrt(x) : 0; }

/// No location of a cell with that reach is farther from its site.
double radius(const WeightedPoint3& site, double reach) { return root(reach + site.weight); }

/// Is that held whose size grows with the reach of x? That is asked for only where bounds cannot tell.
template <class Holds>
bool holds_by_reach(SurfaceDomain& domain, SiteId x, Holds holds) {
  const geom::RestrictedDual& dual = domain.dual();
  return holds(dual.reach_bound(x)) || (holds(dual.least_reach(x)) && holds(domain.reach(x)));
}

}  // namespace

bool TileGuard::holds_ball(const Vec3& center, double radius) const {
  const double r = radius * (1 + 1e-9) + margin_;
  const Vec3 at = in_frame(tile_.frame, center);
  return (at.array() - r > tile_.box.min().array()).all() && (at.array() + r < tile_.box.max().array()).all();
}

double TileGuard::room_around(const Vec3& center) const {
  const Vec3 at = in_frame(tile_.frame, center);
  const double room = std::min((at - tile_.box.min()).minCoeff(), (tile_.box.max() - at).minCoeff());
  return room * (1 - 1e-9) - margin_;
}

/// Is it a T-site and its cell made of T-locations, given a bound of the power there?
bool TileGuard::holds_cell(const WeightedPoint3& site, double reach, double power) const {
  return holds_ball(site.position, std::max(radius(site, reach) + root(power), root(site.weight)));
}

bool TileGuard::is_clear_of_cuts(SurfaceDomain& domain, SiteId x) const {
  const WeightedPoint3& site = domain.dual().site(x);
  return holds_by_reach(domain, x, [&](double reach) {
    return holds_ball(domain.sample(x).position, likely_clearance * radius(site, reach));
  });
}

bool TileGuard::may_vacate(SurfaceRemoval& removal, Scope scope) {
  return holds(removal, scope) || (removal.sharpen() && holds(removal, scope));
}

/// Is what x vacates held, and its place, and what the choice depends on?
bool TileGuard::holds(SurfaceRemoval& removal, Scope scope) const {
  const geom::RestrictedDual& dual = removal.domain().dual();
  const SurfaceRemoval::Vacancy vacancy = removal.vacancy();
  const WeightedPoint3& site = dual.site(removal.sample());
  double at_x = std::numeric_limits<double>::infinity();
  for (const SiteId y : vacancy.around) at_x = std::min(at_x, geom::power(site.position, dual.site(y)));
  const double power = std::max(vacancy.power, at_x);
  return power <= most_power_ && holds_cell(site, vacancy.reach, power) &&
         (scope != Scope::two_ring || holds_heirs(removal.domain(), vacancy));
}

/// Are the cells where Scope::two_ring looks held?
bool TileGuard::holds_heirs(SurfaceDomain& domain, const SurfaceRemoval::Vacancy& vacancy) const {
  return std::ranges::all_of(vacancy.around, [&](SiteId y) {
    return holds_by_reach(domain, y, [&](double reach) {
      return holds_cell(domain.dual().site(y), reach, std::max(vacancy.power, reach));
    });
  });
}

bool TileGuard::offers(const geom::EmptyCircle& circle, const WeightedPoint3& site) const {
  return holds_ball(circle.center, circle_clearance * root(circle.radius2 + site.weight)) &&
         std::ranges::find(barred_, circle.center) == barred_.end();
}

/// x is now on a site that had the power circle.radius2 there.
bool TileGuard::may_keep(SurfaceDomain& domain, SiteId x, const geom::EmptyCircle& circle) {
  const WeightedPoint3& site = domain.dual().site(x);
  const double weight = domain.dual().site(circle.sites[0]).weight;
  const double distance = root(circle.radius2 + weight);
  const auto holds = [&](double reach) {
    return holds_cell(site, reach, std::pow(radius(site, reach) + distance, 2) - weight);
  };
  if (holds_by_reach(domain, x, holds)) return true;
  barred_.push_back(circle.center);
  return false;
}

}  // namespace fpo
