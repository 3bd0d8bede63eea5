#include "geom/power/facet_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "geom/hilbert.h"

namespace geom {
namespace {

constexpr std::size_t memory = 1024;   // sites whose surroundings are kept
constexpr double more = 1 + 1e-9;      // for the rounding of distances and powers
constexpr double radius_guess = 1.25;  // in radii of the fragment before, or distances to the nearest site
constexpr double radius_memory = 0.9;  // a guess is at least so much of the guess before
constexpr double radius_step = 1.5;
constexpr int most_steps = 6;   // from the nearest site of one facet to that of the next
constexpr double far_away = 2;  // in likely radii: a facet so far from its site is not the next one

double root(double x) { return x > 0 ? std::sqrt(x) : 0; }

/// The power to a site of that weight at a distance, and the distance where it has that power: both rounded
/// up, whatever cancels out.
double power_at(double distance2, double weight) {
  return distance2 - weight + (more - 1) * (distance2 + std::abs(weight));
}
double distance_at(double power, double weight) {
  return root(power + weight + (more - 1) * (std::abs(power) + std::abs(weight))) * more;
}

Vec3 centroid(const TriMesh& mesh, FacetId t) {
  return (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
}
double middle_level(const TriMesh& mesh, FacetId t) {
  const auto [a, b, c] = mesh.facet(t);
  return (mesh.level(a) + mesh.level(b) + mesh.level(c)) / 3;
}

}  // namespace

FacetCells::FacetCells(const TriMesh& mesh, const Clipper::Sites& sites, const Clipper& clipper,
                       const NearSites& search)
    : mesh_(mesh),
      sites_(sites),
      clipper_(clipper),
      search_(search),
      known_(memory),
      stamp_of_(sites.size(), 0) {}

std::span<const FacetPolygon> FacetCells::divide(FacetId t) {
  num_found_ = 0;
  ++stamp_;
  const Vec3 middle = centroid(mesh_, t);
  const SiteId first = nearest({middle, middle_level(mesh_, t)});
  follow(first, t);
  last_ = first;
  if (num_found_ == 0) {  // powers tie there, or rounding moved the centroid off a tiny facet
    find_owners(t, first);
    for (const SiteId s : may_own_) follow(s, t);
    ensure(num_found_ > 0, "facet cells: a facet without owner");
  }
  return std::span(found_).first(num_found_);
}

/// Facets come one after the other: from the nearest of the one before to whoever is nearer among those
/// around it, and so on. The nearest of all is known where somebody's power is one whose surroundings are
/// known: it is among these. After too many steps, or too long ones, the search tells.
SiteId FacetCells::nearest(const Location3& x) {
  SiteId at = last_;
  for (int step = 0; at.valid() && step < most_steps; ++step) {
    Surroundings& around = surroundings(at);
    SiteId best = at;
    double radius2 = power(x, sites_[at]);
    const double bound = radius2 + (more - 1) * (std::abs(radius2) + std::abs(around.heaviest));
    const double needed = distance_at(bound, sites_[at].weight);
    const double security = needed + distance_at(bound, around.heaviest);
    for (const Near& j : around.sites) {
      if (j.distance > security) break;
      const double other = power(x, sites_[j.site]);
      if (other < radius2 || (other == radius2 && j.site < best)) best = j.site, radius2 = other;
    }
    if (bound <= around.power) return best;
    if (best == at && needed > far_away * likely_radius_) break;
    if (best == at) look_around(around, needed);
    at = best;
  }
  return search_.nearest(x, SiteId(), SiteId()).site;
}

/// Adds the fragments of a site and of all that border them.
void FacetCells::follow(SiteId first, FacetId t) {
  if (is_new(first)) waiting_.push_back(first);
  while (!waiting_.empty()) {
    if (num_found_ == found_.size()) found_.emplace_back();
    FacetPolygon& polygon = found_[num_found_];
    clipper_.start(polygon, t, waiting_.back());
    waiting_.pop_back();
    if (!clip(polygon)) continue;
    std::rotate(polygon.corners.begin(), std::ranges::min_element(polygon.corners, {}, &PolygonCorner::edge),
                polygon.corners.end());
    ++num_found_;
    for (const PolygonCorner& corner : polygon.corners)
      if (corner.edge.is_site() && is_new(corner.edge.site())) waiting_.push_back(corner.edge.site());
  }
}

bool FacetCells::is_new(SiteId s) {
  if (stamp_of_[s] == stamp_) return false;
  stamp_of_[s] = stamp_;
  return true;
}

/// Cuts the facet down to the cell of polygon.owner. False if nothing is left. After a wider look those known
/// before clip again, to no effect: what is left is on their other side, ties included.
bool FacetCells::clip(FacetPolygon& polygon) {
  Surroundings& around = surroundings(polygon.owner);
  double bound = 0;
  for (;;) {
    if (!clip(polygon, around, bound)) return false;
    const double weight = sites_[polygon.owner].weight;
    const double needed = distance_at(bound, weight);
    if (bound <= around.power) {
      likely_radius_ = std::max(radius_guess * needed, radius_memory * likely_radius_);
      return true;
    }
    const double seen = distance_at(around.power, weight);
    look_around(around, seen > 0 ? std::min(needed, radius_step * seen) : needed);
  }
}

/// By what is known to be around the owner. False if nothing is left. `bound`: of the power on what is left.
bool FacetCells::clip(FacetPolygon& polygon, const Surroundings& around, double& bound) {
  const double weight = sites_[polygon.owner].weight;
  double security = 0;
  const auto measure = [&] {
    bound = clipper_.bound_power(polygon);
    const double own = distance_at(bound, weight);
    security = own + (around.heaviest == weight ? own : distance_at(bound, around.heaviest));
  };
  measure();
  bool is_measured = true;
  for (const Near& j : around.sites) {
    if (j.distance > security) break;
    const Clip outcome = clipper_.clip(polygon, j.site, j.bisector);
    if (outcome == Clip::swallowed) return false;
    if (outcome == Clip::untouched && !is_measured) measure();  // perhaps that was the last one that matters
    is_measured = outcome == Clip::untouched;
  }
  if (!is_measured) measure();
  return true;
}

FacetCells::Surroundings& FacetCells::surroundings(SiteId owner) {
  Surroundings& around = known_[owner.index() % known_.size()];
  if (around.owner == owner) return around;
  around.owner = owner;
  if (!(likely_radius_ > 0)) {
    const SiteId nearest = search_.nearest(sites_[owner].position, owner, SiteId()).site;
    if (nearest.valid())
      likely_radius_ = radius_guess * (sites_[nearest].position - sites_[owner].position).norm();
  }
  look_around(around, likely_radius_);
  return around;
}

/// All that matters up to that radius from the owner.
void FacetCells::look_around(Surroundings& around, double radius) {
  const WeightedPoint3& owner = sites_[around.owner];
  around.power = power_at(radius * radius, owner.weight);
  candidates_.clear();
  search_.heirs({around.owner, owner.position, distance_at(around.power, owner.weight), around.power},
                candidates_);
  sites_looked_at_ += candidates_.size();
  by_distance_.clear();
  around.heaviest = owner.weight;
  for (const SiteId j : candidates_) {
    if (j == around.owner) continue;
    by_distance_.emplace_back((sites_[j].position - owner.position).norm(), j);
    around.heaviest = std::max(around.heaviest, sites_[j].weight);
  }
  std::ranges::sort(by_distance_);
  around.sites.clear();
  for (const auto& [distance, j] : by_distance_)
    around.sites.push_back({distance, j, clipper_.bisector_of(around.owner, j)});
}

/// All that can own anything of the facet: nowhere there has the owner more power than the farthest corner
/// has to the first site.
void FacetCells::find_owners(FacetId t, SiteId first) {
  const WeightedPoint3& site = sites_[first];
  const Vec3 middle = centroid(mesh_, t);
  double radius2 = 0, power = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3& q = mesh_.corner(t, i);
    const double rise = mesh_.level(mesh_.facet(t)[static_cast<std::size_t>(i)]) - site.level;
    radius2 = std::max(radius2, (q - middle).squaredNorm());
    power = std::max(power, power_at((q - site.position).squaredNorm() + rise * rise, site.weight));
  }
  may_own_.clear();
  search_.heirs({SiteId(), middle, root(radius2) * more, power}, may_own_);
}

bool is_degenerate(const TriMesh& mesh, FacetId t) {
  const auto turns_in = [&](int x, int y) {  // seen along the third axis
    const auto seen = [&](int i) { return Vec2(mesh.corner(t, i)[x], mesh.corner(t, i)[y]); };
    return orient2(seen(0), seen(1), seen(2)) != 0;
  };
  return !turns_in(0, 1) && !turns_in(1, 2) && !turns_in(2, 0);
}

std::vector<FacetId> facets_along_curve(const TriMesh& mesh) {
  std::vector<Vec3> middles;
  middles.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    middles.push_back(centroid(mesh, t));
  std::vector<FacetId> facets;
  facets.reserve(mesh.num_facets());
  for (const std::uint32_t i : hilbert_order(middles, mesh.box())) facets.emplace_back(std::size_t{i});
  return facets;
}

}  // namespace geom
