#include "geom/dual/state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

DualState::DualState(const TriMesh& surface, CornerTypes corners, NeighbourOracle* source)
    : mesh(surface),
      has_levels(surface.has_levels()),
      types(corners),
      extent(extent_of(surface)),
      paper(source),
      clipper(surface, sites, extent),
      facets(surface, facets_along_curve(surface)) {
  ensure(!paper || !has_levels, "restricted dual: the regular triangulation knows no levels");
  if (types == CornerTypes::c_only) return;
  first_facet.resize(mesh.num_vertices());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh.facet(t))
      if (!first_facet[v].valid()) first_facet[v] = t;
}

void DualState::admit(SiteId p, const WeightedPoint3& point) {
  ensure(point.position.lpNorm<Eigen::Infinity>() <= extent,
         "restricted dual: a site outside the mesh's box");
  if (p.index() >= sites.size()) {
    sites.resize(p.index() + 1);
    reach.resize(p.index() + 1, -std::numeric_limits<double>::infinity());
    home.resize(p.index() + 1);
    shape_.resize(p.index() + 1, Shape::regular);
    place_of_.resize(p.index() + 1, 0);
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
  if (!grid.is_in_use()) return;
  grid.move(p, from, sites[p].position);
  if (shape_[p] != Shape::regular) grid_of_these_.move(p, from, sites[p].position);
}

void DualState::set_shape(SiteId p, Shape shape) {
  if ((shape_[p] == Shape::regular) != (shape == Shape::regular)) {
    if (shape == Shape::regular) {
      const SiteId last = not_regular_.back();
      not_regular_[place_of_[p]] = last;
      place_of_[last] = place_of_[p];
      not_regular_.pop_back();
      if (grid.is_in_use()) grid_of_these_.remove(p, sites[p].position);
    } else {
      if (grid.is_in_use()) grid_of_these_.insert(p, sites[p].position);
      place_of_[p] = static_cast<std::uint32_t>(not_regular_.size());
      not_regular_.push_back(p);
    }
  }
  shape_[p] = shape;
}

void DualState::irregular_rivals(SiteId p, std::vector<SiteId>& out) {
  const double distance = 2 * distance_at(largest_reach());
  if (grid.is_in_use() && grid_of_these_.is_short(distance)) {
    grid_of_these_.near(sites[p].position, distance, out);
  } else if (not_regular_.size() <= few) {
    out.insert(out.end(), not_regular_.begin(), not_regular_.end());
  } else {
    const auto old = static_cast<std::ptrdiff_t>(out.size());
    tree.rivals(sites[p], out);
    out.erase(
        std::remove_if(out.begin() + old, out.end(), [&](SiteId s) { return shape(s) == Shape::regular; }),
        out.end());
  }
}

void DualState::choose_search() {
  const auto [least, most] = std::ranges::minmax(sites, {}, &WeightedPoint3::weight);
  double area = mesh.area();
  const double spacing = std::sqrt(area / static_cast<double>(num_sites));
  if (least.weight != most.weight || !(spacing > 0) || extent > 1e5 * spacing) return;
  grid = SiteGrid(cell_of_grid * spacing, num_sites);
  grid_of_these_ = SiteGrid(2 * cell_of_grid * spacing, 0);
  for (const SiteId p : not_regular_) grid_of_these_.insert(p, sites[p].position);
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
    for (const CircleId c : circles.of_site(without))
      for (const SiteId s : circles[c].sites)
        if (s.valid() && s != without) bound = std::min(bound, power(x, sites[s]));
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

bool DualState::corner_circle(const Polygon& polygon, std::size_t corner, EmptyCircle& out) const {
  const EdgeLabel before = polygon.corners[previous_corner(corner, polygon.corners.size())].edge,
                  after = polygon.corners[corner].edge;
  if ((before.is_site() && before.site() < polygon.owner) ||
      (after.is_site() && after.site() < polygon.owner))
    return false;
  return corner_circle_of_any(polygon, corner, out);
}

bool DualState::corner_circle_of_any(const Polygon& polygon, std::size_t corner, EmptyCircle& out) const {
  const EdgeLabel before = polygon.corners[previous_corner(corner, polygon.corners.size())].edge,
                  after = polygon.corners[corner].edge;
  out = EmptyCircle();
  out.facet = polygon.facet;
  out.sites[0] = polygon.owner;
  if (before.is_site() && after.is_site()) {
    out.sites = {polygon.owner, before.site(), after.site()};
    out.sort_counterclockwise();
  } else if (types == CornerTypes::c_only) {
    return false;
  } else if (before.is_site() || after.is_site()) {
    const EdgeLabel edge = before.is_site() ? after : before, site = before.is_site() ? before : after;
    const FacetId across = mesh.across(polygon.facet, edge.edge());
    if (across.valid() && across < polygon.facet) return false;
    out.sites = {std::min(polygon.owner, site.site()), std::max(polygon.owner, site.site()), SiteId()};
    out.place = static_cast<std::int16_t>(1 + edge.edge());
  } else {
    const int i = after.edge();  // edges i - 1 and i meet in corner i
    if (first_facet[mesh.facet(polygon.facet)[static_cast<std::size_t>(i)]] != polygon.facet) return false;
    out.place = static_cast<std::int16_t>(4 + i);
  }
  center_circle(out, polygon.corners[corner].point.position);
  return true;
}

EmptyCircle DualState::circle_of(const std::array<SiteId, 3>& sites_around, FacetId facet,
                                 const RoundedPoint& place) const {
  EmptyCircle circle;
  circle.facet = facet;
  circle.sites = sites_around;
  circle.sort_counterclockwise();
  center_circle(circle, place.position);
  return circle;
}

CellCorner DualState::corner_of(const EmptyCircle& circle, double tolerance) const {
  const auto edge = [](int e) { return EdgeLabel::facet_edge(e); };
  CellCorner corner{circle.facet, circle.sites[0], EdgeLabel(), EdgeLabel(), {circle.center, tolerance}};
  if (circle.is_triangle()) {
    corner.before = EdgeLabel::bisector(circle.sites[1]);
    corner.after = EdgeLabel::bisector(circle.sites[2]);
  } else if (circle.sites[1].valid()) {
    corner.before = edge(circle.place - 1);
    corner.after = EdgeLabel::bisector(circle.sites[1]);
  } else {
    corner.before = edge(circle.place == 4 ? 2 : circle.place - 5);
    corner.after = edge(circle.place - 4);
  }
  return corner;
}

void DualState::center_circle(EmptyCircle& circle, const Vec3& corner) const {
  const Vec3 &q0 = mesh.corner(circle.facet, 0), &q1 = mesh.corner(circle.facet, 1),
             &q2 = mesh.corner(circle.facet, 2);
  circle.center =
      snapped(corner.cwiseMax(q0.cwiseMin(q1).cwiseMin(q2)).cwiseMin(q0.cwiseMax(q1).cwiseMax(q2)));
  const double level = clipper.levels().at(circle.facet, circle.center);
  circle.radius2 = power(Location3(circle.center, level), sites[circle.sites[0]]);
}

}  // namespace geom
