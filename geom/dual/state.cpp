#include "geom/dual/state.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/power/facet_cells.h"
#include "geom/power/restricted_power.h"

namespace geom {
namespace {

constexpr std::size_t few = 40;      // sites are looked at one by one
constexpr double shapes_cell = 4.8;  // of the grid of irregular sites, in spacings

}  // namespace

std::span<const CircleId> create_all(std::span<const EmptyCircle> found, EmptyCircles& circles,
                                     DualChange& change) {
  const std::size_t first = change.circles_created.size();
  for (const EmptyCircle& circle : found) change.circles_created.push_back(circles.create(circle));
  return std::span<const CircleId>(change.circles_created).subspan(first);
}

DualState::DualState(const TriMesh& surface, CornerTypes types, NeighbourOracle* source)
    : mesh(surface),
      has_levels(surface.has_levels()),
      extent(extent_of(surface)),
      paper(source),
      search(sites, circles),
      leeways(sites, search),
      reach(search),
      clipper(surface, sites, extent),
      corners(clipper, mesh, sites, types),
      facets(surface, facets_along_curve(surface)) {
  ensure(!paper || !has_levels, "restricted dual: the regular triangulation knows no levels");
}

void DualState::reserve(std::size_t num_sites) {
  sites.reserve(num_sites);
  search.tree().reserve(num_sites);
  reach.reserve(num_sites);
  home.reserve(num_sites);
  shapes.reserve(num_sites);
}

void DualState::admit(SiteId p, const WeightedPoint3& point) {
  ensure(point.position.lpNorm<Eigen::Infinity>() <= extent,
         "restricted dual: a site outside the mesh's box");
  if (p.index() >= sites.size()) {
    sites.resize(p.index() + 1);
    reach.resize(p.index() + 1);
    home.resize(p.index() + 1);
    shapes.resize(p.index() + 1);
  }
  sites[p] = point;
  search.allow(point.weight);
  leeways.allow(point.weight);
}

void DualState::follow(SiteId p, const Vec3& from) {
  search.follow(p, from);
  leeways.arrive(p, (sites[p].position - from).norm());
  shapes.follow(p, from, sites[p].position);
}

void DualState::choose_search() {
  const double spacing = search.choose(mesh.area(), extent);
  if (!(spacing > 0)) return;
  shapes.use_grid(shapes_cell * spacing, sites);
  if (!has_levels && !paper && corners.types() == CornerTypes::c_only) leeways.begin(spacing);
}

/// With leeway nobody is nearer to a site than the nearest of its rim and of the strangers kept.
NeighbourOracle::Nearest DualState::nearest(const Location3& x, SiteId without) const {
  const Leeway* const leeway =
      without.valid() && sites[without].position == x.position ? leeways.of(without) : nullptr;
  if (!leeway) return search.nearest(x, without);
  NeighbourOracle::Nearest best{SiteId(), infinity};
  for (const Leeway::Watched& watched : leeway->all().first(leeway->num_rim + leeway->num_kept)) {
    const SiteId s = watched.site;
    if (!search.tree().contains(s)) return search.nearest(x, without);
    const double radius2 = power(x, sites[s]);
    if (radius2 < best.radius2 || (radius2 == best.radius2 && s < best.site)) best = {s, radius2};
  }
  return best;
}

void DualState::enter(SiteId p) {
  search.enter(p);
  leeways.arrive(p, infinity);
}

void DualState::leave(SiteId p) {
  search.leave(p);
  leeways.leave(p);
}

void DualState::irregular_rivals(SiteId p, std::vector<SiteId>& out) {
  const double distance = 2 * distance_at(reach.largest());
  if (shapes.find_near(sites[p].position, distance, out)) return;
  const std::span<const SiteId> suspects = shapes.not_regular();
  if (suspects.size() <= few) {
    out.insert(out.end(), suspects.begin(), suspects.end());
    return;
  }
  const auto old = static_cast<std::ptrdiff_t>(out.size());
  search.tree().rivals(sites[p], out);
  const auto is_regular = [&](SiteId s) { return shapes[s] == CellShape::regular; };
  out.erase(std::remove_if(out.begin() + old, out.end(), is_regular), out.end());
}

bool DualState::leads_at_its_place(SiteId j, const WeightedPoint3& other) const {
  if (!home[j].valid()) return false;
  const WeightedPoint3& site = sites[j];
  const double off = 2 * clipper.most_tolerance();
  const Sure lead =
      lead_of(site, other, {site.position, site.level, off + clipper.levels().off(home[j], off)});
  return lead.value > 4 * lead.bound;  // others may be nearer by a part of the bound
}

double DualState::distance_at(double power) const {
  const double distance2 = power + search.heaviest() + 1e-9 * (std::abs(power) + search.heaviest());
  return distance2 > 0 ? std::sqrt(distance2) * (1 + 1e-9) : 0;
}

bool DualState::is_level(const EmptyCircle& circle, double level) const {
  return !has_levels ||
         (clipper.levels().is_flat_at(circle.facet, level) &&
          std::ranges::all_of(circle.sites, [&](SiteId s) { return !s.valid() || sites[s].level == level; }));
}

double DualState::distance_at(double power, SiteId p) const {
  const double weight = sites[p].weight;
  const double distance2 = power + weight + 1e-9 * (std::abs(power) + std::abs(weight));
  return distance2 > 0 ? std::sqrt(distance2) * (1 + 1e-9) : 0;
}

}  // namespace geom
