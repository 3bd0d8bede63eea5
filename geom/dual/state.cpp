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

constexpr double cell_of_grid = 2.4;  // in square roots of the area of a cell
constexpr std::size_t few = 40;       // sites are looked at one by one

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
      clipper(surface, sites, extent),
      corners(clipper, mesh, sites, types),
      facets(surface, facets_along_curve(surface)) {
  ensure(!paper || !has_levels, "restricted dual: the regular triangulation knows no levels");
}

void DualState::admit(SiteId p, const WeightedPoint3& point) {
  ensure(point.position.lpNorm<Eigen::Infinity>() <= extent,
         "restricted dual: a site outside the mesh's box");
  if (p.index() >= sites.size()) {
    sites.resize(p.index() + 1);
    reach.resize(p.index() + 1, -std::numeric_limits<double>::infinity());
    home.resize(p.index() + 1);
    shapes.resize(p.index() + 1);
  }
  sites[p] = point;
  heaviest_ = std::max(heaviest_, point.weight);
}

void DualState::enter(SiteId p) {
  tree.insert(p, sites[p]);
  if (grid.is_in_use()) grid.insert(p, sites[p].position);
  ++num_sites;
}

void DualState::leave(SiteId p) {
  tree.remove(p);
  if (grid.is_in_use()) grid.remove(p, sites[p].position);
  --num_sites;
}

void DualState::follow(SiteId p, const Vec3& from) {
  tree.move(p, sites[p]);
  if (grid.is_in_use()) grid.move(p, from, sites[p].position);
  shapes.follow(p, from, sites[p].position);
}

void DualState::irregular_rivals(SiteId p, std::vector<SiteId>& out) {
  const double distance = 2 * distance_at(largest_reach());
  if (shapes.find_near(sites[p].position, distance, out)) return;
  const std::span<const SiteId> suspects = shapes.not_regular();
  if (suspects.size() <= few) {
    out.insert(out.end(), suspects.begin(), suspects.end());
    return;
  }
  const auto old = static_cast<std::ptrdiff_t>(out.size());
  tree.rivals(sites[p], out);
  const auto is_regular = [&](SiteId s) { return shapes[s] == CellShape::regular; };
  out.erase(std::remove_if(out.begin() + old, out.end(), is_regular), out.end());
}

void DualState::choose_search() {
  const auto [least, most] = std::ranges::minmax(sites, {}, &WeightedPoint3::weight);
  double area = mesh.area();
  const double spacing = std::sqrt(area / static_cast<double>(num_sites));
  if (least.weight != most.weight || !(spacing > 0) || extent > 1e5 * spacing) return;
  grid = SiteGrid(cell_of_grid * spacing, num_sites);
  shapes.use_grid(2 * cell_of_grid * spacing, sites);
  for (SiteId p(0); p.index() < sites.size(); p = SiteId(p.value + 1))
    if (tree.contains(p)) grid.insert(p, sites[p].position);
}

void DualState::near(const Vacancy& vacancy, std::vector<SiteId>& out) const {
  const double far2 = vacancy.max_radius2 + heaviest_;
  const double distance = vacancy.radius + (far2 > 0 ? std::sqrt(far2) : 0);
  if (grid.is_in_use() && grid.is_short(distance))
    grid.near(vacancy.center, distance, out);
  else
    tree.heirs(vacancy, out);
}

double DualState::distance_at(double power) const {
  const double distance2 = power + heaviest_ + 1e-9 * (std::abs(power) + heaviest_);
  return distance2 > 0 ? std::sqrt(distance2) * (1 + 1e-9) : 0;
}

bool DualState::find_near(const Vec3& x, double distance, std::vector<SiteId>& out) const {
  if (!grid.is_in_use() || !grid.is_short(distance)) return false;
  grid.near(x, distance, out);
  return true;
}

/// A site beside one that is in bounds the distance.
NeighbourOracle::Nearest DualState::nearest(const Location3& x, SiteId without) const {
  double bound = std::numeric_limits<double>::infinity();
  if (grid.is_in_use() && without.valid())
    for (const CircleId c : circles.of_site(without)) {
      const EmptyCircle& circle = circles[c];
      const SiteId s = circle.sites[circle.after(circle.index_of(without))];
      if (s.valid()) bound = std::min(bound, power(x, sites[s]));
    }
  const double distance = std::sqrt(std::max(0.0, bound + heaviest_)) * (1 + 1e-9);
  if (!(distance < std::numeric_limits<double>::infinity()) || !grid.is_short(distance))
    return tree.nearest(x, without);
  std::vector<SiteId>& found = found_;
  found.clear();
  grid.near(x.position, distance, found);
  NeighbourOracle::Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
  for (const SiteId s : found) {
    if (s == without) continue;
    const double radius2 = power(x, sites[s]);
    if (radius2 < best.radius2 || (radius2 == best.radius2 && s < best.site)) best = {s, radius2};
  }
  return best;
}

bool DualState::is_level(const EmptyCircle& circle, double level) const {
  return !has_levels ||
         (clipper.levels().is_flat_at(circle.facet, level) &&
          std::ranges::all_of(circle.sites, [&](SiteId s) { return !s.valid() || sites[s].level == level; }));
}

double DualState::largest_reach() {
  if (++changes_ > num_sites / 2) {
    changes_ = 0;
    largest_reach_ = -std::numeric_limits<double>::infinity();
    for (const double r : reach) largest_reach_ = std::max(largest_reach_, r);
  }
  return largest_reach_;
}

void DualState::set_reach(SiteId p, double value) {
  reach[p] = value;
  largest_reach_ = std::max(largest_reach_, value);
  tree.set_reach(p, value);
}

double DualState::distance_at(double power, SiteId p) const {
  const double weight = sites[p].weight;
  const double distance2 = power + weight + 1e-9 * (std::abs(power) + std::abs(weight));
  return distance2 > 0 ? std::sqrt(distance2) * (1 + 1e-9) : 0;
}

}  // namespace geom
