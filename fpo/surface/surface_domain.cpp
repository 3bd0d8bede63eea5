#include "fpo/surface/surface_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/rng.h"
#include "geom/sites/triangulation_oracle.h"

namespace fpo {
namespace {

constexpr double weight_unit = geom::coordinate_unit * geom::coordinate_unit;
constexpr Circle no_circle{-std::numeric_limits<double>::infinity(), CircleId()};

std::unique_ptr<geom::NeighbourOracle> make_source(Engine engine, const geom::Box3& box) {
  if (engine == Engine::search) return nullptr;
  return std::make_unique<geom::TriangulationOracle>(box);
}

/// The heap's order.
bool larger_circle(const geom::EmptyCircle& a, const geom::EmptyCircle& b) {
  return a.radius2 > b.radius2 || (a.radius2 == b.radius2 && circle_before(a, b));
}

}  // namespace

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const SurfaceOptions& options)
    : SurfaceDomain(mesh, Sizing::uniform(hexagonal_spacing(mesh.area(), samples.size())), samples, options) {
}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing,
                             std::span<const SurfaceSample> samples, const SurfaceOptions& options)
    : SurfaceDomain(mesh, sizing, samples, geom::Table<SiteId, double>(samples.size(), 1.0), options) {}

SurfaceDomain SurfaceDomain::rebuilt() const {
  return SurfaceDomain(mesh_, sizing_, std::span(samples_.data(), samples_.size()), weight_share_, options_);
}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing,
                             std::span<const SurfaceSample> samples,
                             geom::Table<SiteId, double> weight_shares, const SurfaceOptions& options)
    : mesh_(mesh),
      sizing_(sizing),
      options_(options),
      samples_(samples.begin(), samples.end()),
      weight_share_(std::move(weight_shares)),
      unweighted_(equal_weights() && std::ranges::count(weight_share_, 1.0) == std::ssize(weight_share_)),
      paper_(mesh.has_levels() ? nullptr : make_source(options.engine, mesh.box())),
      dual_(std::make_unique<geom::RestrictedDual>(mesh, options.corners, paper_.get())),
      circles_(CircleOrder{dual_.get()}) {
  geom::require(!samples.empty(), "there must be at least one sample");
  std::vector<SiteId> order;
  for (std::size_t i = 0; i < samples.size(); ++i) order.emplace_back(i);
  geom::Rng(options.seed).shuffle(std::span(order));
  std::vector<geom::WeightedPoint3> points;
  points.reserve(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) points.push_back(point_of(SiteId(i)));
  std::vector<geom::FacetId> homes;
  for (const SurfaceSample& x : samples_) homes.push_back(x.facet);
  apply(dual_->build(points, homes, order, options_.threads));
}

std::unique_ptr<geom::RestrictedPower> SurfaceDomain::diagram() const {
  std::vector<geom::WeightedPoint3> points;
  points.reserve(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) points.push_back(dual_->site(SiteId(i)));
  return std::make_unique<geom::RestrictedPower>(mesh_, points, dual_->tree(), options_.threads);
}

double SurfaceDomain::full_weight(SiteId x) const {
  const double radius = options_.weight_factor * sizing_.at(samples_[x]);
  return radius * radius;
}

/// A uniform diagram is that of equal weights, whatever these are: 0. A smaller weight is negative then.
double SurfaceDomain::weight_at(SiteId x) const {
  if (equal_weights() && weight_share_[x] == 1) return 0;
  return geom::snapped((weight_share_[x] - (equal_weights() ? 1 : 0)) * full_weight(x), weight_unit);
}

void SurfaceDomain::expect(SiteId x) {
  dual_->expect(x, 4);
  for (int i = 0; i < 3; ++i)
    if (const SiteId y = expected_[static_cast<std::size_t>(i)]; y.valid()) dual_->expect(y, 3 - i);
  expected_ = {x, expected_[0], expected_[1]};
}

geom::WeightedPoint3 SurfaceDomain::point_of(SiteId x) const {
  const auto& [position, facet] = samples_[x];
  if (!mesh_.has_levels()) return {position, weight_at(x)};
  return {position, weight_at(x), geom::snapped(dual_->level_at(facet, position), geom::coordinate_unit)};
}

geom::NeighbourOracle::Nearest SurfaceDomain::nearest_to(SiteId x) const {
  return dual_->nearest({samples_[x].position, dual_->site(x).level}, x);
}

double SurfaceDomain::separation(SiteId x) { return nearest_to(x).radius2; }

// One move, forward only: the neighbour source, then the diagram, then the heap.

void SurfaceDomain::remove(SiteId x) {
  near_removed_ = SiteId();
  if (!dual_->has_cell(x)) near_removed_ = nearest_to(x).site;
  apply(dual_->remove(x));
}

Circle SurfaceDomain::largest_empty(Scope scope) {
  if (scope == Scope::two_ring) return largest_in_two_ring();
  if (circles_.empty()) return no_circle;
  return {circles_.top().key, circles_.top().slot};
}

/// Among the circles on the cells of the removed sample's neighbours: two rings of the RRT around it.
Circle SurfaceDomain::largest_in_two_ring() {
  CircleId best;
  const auto look_around = [&](SiteId y) {
    for (const CircleId c : dual_->circles_of(y))
      if (!best.valid() || larger(c, best)) best = c;
  };
  for (const SiteId y : last_change_->cells) look_around(y);
  if (last_change_->cells.empty() && near_removed_.valid()) look_around(near_removed_);
  return best.valid() ? Circle{dual_->circle(best).radius2, best} : no_circle;
}

bool SurfaceDomain::larger(CircleId a, CircleId b) const {
  return larger_circle(dual_->circle(a), dual_->circle(b));
}

bool SurfaceDomain::is_farther(const Circle& c, SiteId x) {
  return is_farther(c.radius2, x, last_change_->cells);
}

/// First against the heirs of the removed cell; one that is nearest of all but no heir is rare.
bool SurfaceDomain::is_farther(double radius2, SiteId x, std::span<const SiteId> heirs) const {
  const geom::Location3 place(samples_[x].position, dual_->site(x).level);
  for (const SiteId y : heirs)
    if (radius2 > geom::power(place, dual_->site(y))) return true;
  return radius2 > dual_->nearest(place, x).radius2;
}

// --- a move at once ------------------------------------------------------------------------------

std::optional<bool> SurfaceDomain::move_directly(SiteId x, Scope scope) {
  const std::optional<geom::RestrictedDual::Plan> plan = plan_removal(x);
  if (!plan) return {};
  const Planned best = largest_planned(x, *plan, scope);
  const bool moves = best.circle && is_farther(best.circle->radius2, x, plan->heirs);
  if (moves)
    move_planned(x, best);
  else
    stay(x);
  if (!best.circle) return {};
  return moves;
}

SurfaceDomain::Planned SurfaceDomain::largest_planned(SiteId x, const geom::RestrictedDual::Plan& plan,
                                                      Scope scope) const {
  Planned best;
  const auto consider = [&](const geom::EmptyCircle& circle, const geom::RestrictedDual::Target& target) {
    if (!best.circle || larger_circle(circle, *best.circle)) best = {&circle, target};
  };
  for (std::size_t i = 0; i < plan.circles.size(); ++i)
    if (scope == Scope::two_ring || is_offered(plan.circles[i])) consider(plan.circles[i], {i, CircleId()});
  if (scope == Scope::two_ring) {
    for (const SiteId y : plan.heirs)
      for (const CircleId c : dual_->circles_of(y))
        if (!dual_->circle(c).touches(x)) consider(dual_->circle(c), {0, c});
  } else if (!circles_.empty()) {
    consider(dual_->circle(circles_.top().slot), {0, circles_.top().slot});
  }
  return best.circle && !best.circle->touches(x) ? best : Planned();
}

void SurfaceDomain::move_planned(SiteId x, const Planned& place) {
  samples_[x] = {place.circle->center, place.circle->facet};
  apply(dual_->move(x, point_of(x), samples_[x].facet, place.target));
}

bool SurfaceDomain::is_offered(const geom::EmptyCircle& circle) const {
  return !options_.offers || options_.offers(circle, dual_->site(circle.sites[0]));
}

void SurfaceDomain::insert_at(SiteId x, const Circle& c) {
  const geom::EmptyCircle circle = dual_->circle(c.id);
  samples_[x] = {circle.center, circle.facet};
  insert(x, c.id);
}

void SurfaceDomain::insert_at(SiteId x, const SurfaceSample& place, double weight_share) {
  geom::ensure(weight_share >= 0, "the share of a weight must not be negative");
  samples_[x] = place;
  weight_share_[x] = weight_share;
  unweighted_ &= weight_share == 1;
  put_back(x);
}

void SurfaceDomain::put_back(SiteId x) { insert(x); }

void SurfaceDomain::insert(SiteId x, CircleId at) {
  apply(dual_->insert(x, point_of(x), samples_[x].facet, at));
}

void SurfaceDomain::apply(const geom::RestrictedDual::Change& change) {
  for (const CircleId c : change.circles_erased)
    if (circles_.contains(c)) circles_.erase(c);
  for (const CircleId c : change.circles_created) {
    const geom::EmptyCircle& circle = dual_->circle(c);
    if (is_offered(circle)) circles_.push(c, circle.radius2);
  }
  for (const CircleId c : change.circles_moved) {
    const geom::EmptyCircle& circle = dual_->circle(c);
    const bool listed = circles_.contains(c), offered = is_offered(circle);
    if (listed && offered) circles_.update(c, circle.radius2);
    if (listed && !offered) circles_.erase(c);
    if (!listed && offered) circles_.push(c, circle.radius2);
  }
  last_change_ = &change;
}

double SurfaceDomain::normalized_spacing(SiteId x) {
  const double h = sizing_.at(samples_[x]);
  const geom::NeighbourOracle::Nearest nearest = nearest_to(x);
  if (!nearest.site.valid()) return std::numeric_limits<double>::infinity();
  double least2 = (samples_[nearest.site].position - samples_[x].position).squaredNorm();
  if (unweighted_ && !mesh_.has_levels()) return std::sqrt(least2) / h;
  neighbours(x, link_);
  for (const SiteId y : link_)
    least2 = std::min(least2, (samples_[y].position - samples_[x].position).squaredNorm());
  return std::sqrt(least2) / h;
}

void SurfaceDomain::neighbours(SiteId x, std::vector<SiteId>& out) {
  dual_->link(x, out);
  if (!out.empty() || num_samples() == 1) return;
  const SiteId hider = nearest_to(x).site;
  if (hider.valid()) out.push_back(hider);
}

std::size_t SurfaceDomain::num_hidden() const {
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < num_samples(); ++i) hidden += !dual_->has_cell(SiteId(i));
  return hidden;
}

void SurfaceDomain::check() const {
  dual_->check();
  circles_.check();
}

}  // namespace fpo
