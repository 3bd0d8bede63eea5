#include "fpo/tiles/tile_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/check.h"

namespace fpo {
namespace {

using geom::Box3;
using geom::FacetId;
using geom::Vec3;

constexpr double first_reach = 2;         // M is the square of so many spacings at first
constexpr double reach_step = 1.5;        // and the reach grows by this factor
constexpr double room_for_removals = 2;   // how much more power than at first may be where a cell is vacated
constexpr double likely_clearance = 2.4;  // in radii of a cell: nearer to a cut it can hardly be removed
constexpr double circle_clearance = 3;    // in radii: within, an insertion hardly ever changes more

double root(double x) { return x > 0 ? std::sqrt(x) : 0; }
double square(double x) { return x * x; }

Box3 box_of(const geom::TriMesh& mesh, std::span<const FacetId> facets) {
  Box3 box;
  for (const FacetId t : facets)
    for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
  return box;
}

}  // namespace

TiledSurface::TiledSurface(const geom::TriMesh& mesh, const Sizing& sizing,
                           std::span<const SurfaceSample> samples, const SurfaceOptions& options,
                           std::vector<Tile> tiles)
    : mesh_(mesh), sizing_(sizing), samples_(samples), options_(options), tiles_(std::move(tiles)) {
  const bool weighted = !sizing.is_uniform() && options.weighted;
  if (weighted) weights_.resize(samples.size());
  for (const Tile& tile : tiles_) {
    double weight = 0, spacing = 0;
    for (const SiteId x : tile.samples) {
      const double h = sizing.at(sample(x));
      spacing = std::max(spacing, h);
      if (weighted)
        weight = std::max(weight, weights_[x.index()] = square(options.weight_factor * h) * (1 + 1e-9));
    }
    tile_weights_.push_back(weight);
    spacings_.push_back(spacing);
  }
}

std::vector<SiteId> TiledSurface::samples_near(const Box3& box, double M) const {
  constexpr double less = 1 - 1e-9;  // for the rounding of distances
  std::vector<SiteId> result;
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    if (tiles_[t].samples.empty() ||
        box.squaredExteriorDistance(tiles_[t].sample_box) * less - tile_weights_[t] > M)
      continue;
    for (const SiteId x : tiles_[t].samples)
      if (box.squaredExteriorDistance(sample(x).position) * less - weight(x) <= M) result.push_back(x);
  }
  std::ranges::sort(result);
  return result;
}

TileDomain::TileDomain(const TiledSurface& whole, std::size_t tile)
    : whole_(whole),
      tile_(whole.tiles()[tile]),
      part_(geom::submesh(whole.mesh(), tile_.facets)),
      margin_(1e-12 * std::max(whole.mesh().box().min().lpNorm<Eigen::Infinity>(),
                               whole.mesh().box().max().lpNorm<Eigen::Infinity>())) {
  const Box3 box = box_of(whole.mesh(), part_.facets);
  std::size_t all = 0;
  for (const Tile& t : whole.tiles()) all += t.samples.size();
  for (double reach = first_reach * whole.largest_spacing(tile);; reach *= reach_step) {
    most_power_ = square(reach);
    sites_ = whole.samples_near(box, most_power_);
    if (sites_.size() == all) most_power_ = std::numeric_limits<double>::infinity();
    build();
    if (room_for_removals * largest_reach() <= most_power_) break;
  }
}

/// The sizing for the samples, whose facets become those of sizing_mesh_: first the facets of the part, then
/// those of samples outside.
Sizing TileDomain::local_sizing(std::vector<SurfaceSample>& samples) {
  for (SurfaceSample& x : samples) x.facet = part_.here(x.facet);
  if (whole_.sizing().is_uniform()) return whole_.sizing();
  std::vector<FacetId> facets = part_.facets;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].facet.valid()) continue;
    samples[i].facet = FacetId(facets.size());
    facets.push_back(whole_.sample(sites_[i]).facet);
  }
  geom::Table<geom::VertexId, Vec3> corners;
  geom::Table<FacetId, geom::TriMesh::Facet> renamed;
  VertexField h;
  for (const FacetId t : facets) {
    geom::TriMesh::Facet& facet = renamed.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const geom::VertexId v = whole_.mesh().facet(t)[i];
      facet[i] = corners.next_id();
      corners.push_back(whole_.mesh().position(v));
      h.push_back(whole_.sizing().at(v));
    }
  }
  geom::TriMesh::Across across(renamed.size());
  sizing_mesh_ =
      geom::TriMesh(std::move(corners), std::move(renamed), std::move(across), whole_.mesh().box());
  return {sizing_mesh_, std::move(h)};
}

void TileDomain::build() {
  std::vector<SurfaceSample> samples;
  for (const SiteId x : sites_) samples.push_back(whole_.sample(x));
  const Sizing sizing = local_sizing(samples);
  SurfaceOptions options = whole_.options();
  options.threads = 1;  // as other tiles have theirs
  options.num_fixed = static_cast<std::size_t>(
      std::ranges::lower_bound(sites_, SiteId(whole_.options().num_fixed)) - sites_.begin());
  options.offers = [this](const geom::EmptyCircle& circle, const geom::WeightedPoint3& site) {
    return offers(circle, site);
  };
  domain_.emplace(part_.mesh, sizing, samples, options);
}

double TileDomain::largest_reach() const {
  double reach = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sites_.size(); ++i)
    reach = std::max(reach, domain_->dual().reach_bound(SiteId(i)));
  return reach;
}

SiteId TileDomain::here(SiteId of_whole) const {
  return SiteId(static_cast<std::size_t>(std::ranges::lower_bound(sites_, of_whole) - sites_.begin()));
}

SurfaceSample TileDomain::sample(SiteId x) const {
  const SurfaceSample& found = domain_->sample(here(x));
  return {found.position, whole_id(found.facet)};
}

std::vector<SiteId> TileDomain::restless(std::span<const SiteId> of_whole, double rest_spacing) {
  std::vector<SiteId> samples(of_whole.begin(), of_whole.end());
  for (SiteId& x : samples) x = here(x);
  samples = fpo::restless(*domain_, samples, rest_spacing);
  for (SiteId& x : samples) x = whole_id(x);
  return samples;
}

/// No location of a cell with that reach is farther from x.
double TileDomain::radius(SiteId x, double reach) const {
  return root(reach + domain_->dual().site(x).weight);
}

/// Is that held whose size follows from the reach of x? The least reach is asked for where a bound is too
/// large.
template <class Holds>
bool TileDomain::holds_by_reach(SiteId x, Holds holds) {
  return holds(domain_->dual().reach_bound(x)) || holds(domain_->reach(x));
}

bool TileDomain::holds_ball(const Vec3& center, double radius) const {
  const double r = radius * (1 + 1e-9) + margin_;
  const Vec3 at = in_frame(tile_.frame, center);
  return (at.array() - r > tile_.box.min().array()).all() && (at.array() + r < tile_.box.max().array()).all();
}

/// Is x a T-site and its cell made of T-locations, given a bound of the power there?
bool TileDomain::holds_cell(SiteId x, double reach, double power) const {
  const geom::WeightedPoint3& site = domain_->dual().site(x);
  return holds_ball(site.position, std::max(radius(x, reach) + root(power), root(site.weight)));
}

/// Is what x vacates held, and its place?
bool TileDomain::holds_vacancy(SiteId x, const Vacancy& vacancy) const {
  const geom::WeightedPoint3& site = domain_->dual().site(x);
  double at_x = std::numeric_limits<double>::infinity();
  for (const SiteId y : vacancy.around)
    at_x = std::min(at_x, geom::power(site.position, domain_->dual().site(y)));
  const double power = std::max(vacancy.power, at_x);
  return power <= most_power_ &&
         holds_ball(site.position, std::max(vacancy.cell + root(power), root(site.weight)));
}

/// Are the cells where Scope::two_ring looks held?
bool TileDomain::holds_heirs(const Vacancy& vacancy) {
  return std::ranges::all_of(vacancy.around, [&](SiteId y) {
    const auto holds = [&](double reach) { return holds_cell(y, reach, std::max(vacancy.power, reach)); };
    return holds(domain_->dual().reach_bound(y)) || holds(domain_->reach(y));
  });
}

bool TileDomain::offers(const geom::EmptyCircle& circle, const geom::WeightedPoint3& site) const {
  return holds_ball(circle.center, circle_clearance * root(circle.radius2 + site.weight)) &&
         std::ranges::find(barred_, circle.center) == barred_.end();
}

TileDomain::Outcome TileDomain::move(SiteId of_whole, Scope scope) {
  const SiteId x = here(of_whole);
  if (domain_->num_samples() == 1) return Outcome::out_of_reach;
  const bool is_clear_of_cuts = holds_by_reach(x, [&](double reach) {
    return holds_ball(domain_->sample(x).position, likely_clearance * radius(x, reach));
  });
  if (!is_clear_of_cuts) return Outcome::out_of_reach;
  if (const std::optional<Outcome> outcome = move_directly(x, scope)) return *outcome;
  return move_step_by_step(x, scope);
}

/// As Domain::move_directly().
std::optional<TileDomain::Outcome> TileDomain::move_directly(SiteId x, Scope scope) {
  const SurfaceSample old = domain_->sample(x);
  std::optional<geom::RestrictedDual::Plan> plan = domain_->plan_removal(x);
  if (!plan) return {};
  const auto stay = [&](std::optional<Outcome> outcome) {
    domain_->stay(x);
    return outcome;
  };
  const auto holds_plan = [&] {
    const Vacancy vacancy{radius(x, plan->reach), plan->max_radius2, plan->heirs, x};
    return holds_vacancy(x, vacancy) && (scope != Scope::two_ring || holds_heirs(vacancy));
  };
  if (!holds_plan()) {
    plan = domain_->plan_exactly(x);
    if (!holds_plan()) return stay(Outcome::out_of_reach);
  }
  const SurfaceDomain::Planned best = domain_->largest_planned(x, *plan, scope);
  if (!best.circle) return stay({});
  if (!domain_->is_farther(best.circle->radius2, x, plan->heirs)) return stay(Outcome::stayed);
  const geom::EmptyCircle circle = *best.circle;
  const geom::WeightedPoint3 touched = domain_->dual().site(circle.sites[0]);
  if (!offers(circle, touched)) return stay(Outcome::out_of_reach);
  domain_->move_planned(x, best);
  if (holds_insertion(x, circle, touched.weight)) return Outcome::moved;
  domain_->remove(x);
  domain_->insert_at(x, old, 1);
  return Outcome::out_of_reach;
}

TileDomain::Outcome TileDomain::move_step_by_step(SiteId x, Scope scope) {
  const SurfaceSample old = domain_->sample(x);
  const double cell = radius(x, domain_->reach(x));
  domain_->remove(x);
  std::vector<SiteId> heirs = domain_->last_change().cells;
  if (heirs.empty())
    heirs.push_back(domain_->dual().nearest({old.position, domain_->dual().site(x).level}, x).site);
  Vacancy vacancy{cell, 0, heirs, SiteId()};
  for (const SiteId heir : heirs) vacancy.power = std::max(vacancy.power, domain_->reach(heir));
  if (!holds_vacancy(x, vacancy) || (scope == Scope::two_ring && !holds_heirs(vacancy))) {
    domain_->put_back(x);
    return Outcome::out_of_reach;
  }
  const Circle c = domain_->largest_empty(scope);
  if (!domain_->is_farther(c, x)) {
    domain_->put_back(x);
    return Outcome::stayed;
  }
  const geom::EmptyCircle circle = domain_->dual().circle(c.id);
  const geom::WeightedPoint3 touched = domain_->dual().site(circle.sites[0]);
  if (offers(circle, touched)) {
    domain_->insert_at(x, c);
    if (holds_insertion(x, circle, touched.weight)) return Outcome::moved;
    domain_->remove(x);
  }
  domain_->insert_at(x, old, 1);
  return Outcome::out_of_reach;
}

/// x is now at the center of what was an empty circle, on a site of that weight: is all that this changed
/// held? Else the circle is not offered again.
bool TileDomain::holds_insertion(SiteId x, const geom::EmptyCircle& circle, double weight) {
  const double distance = root(circle.radius2 + weight);
  const auto holds = [&](double reach) {
    return holds_cell(x, reach, square(radius(x, reach) + distance) - weight);
  };
  if (holds_by_reach(x, holds)) return true;
  barred_.push_back(circle.center);
  return false;
}

}  // namespace fpo
