#include "fpo/surface_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geom/check.h"
#include "geom/facet_cells.h"
#include "geom/rng.h"
#include "geom/scaling.h"
#include "geom/site_tree.h"
#include "geom/triangulation_source.h"

namespace fpo {
namespace {

constexpr double weight_unit = geom::coordinate_unit * geom::coordinate_unit;
constexpr Circle no_circle{-std::numeric_limits<double>::infinity(), CircleId()};

std::unique_ptr<geom::NeighbourSource> make_source(Engine engine, const geom::Box3& box) {
  if (engine == Engine::search) return std::make_unique<geom::SiteTree>();
  return std::make_unique<geom::TriangulationSource>(box);
}

/// The heap's order.
bool larger_circle(const geom::EmptyCircle& a, const geom::EmptyCircle& b) {
  return a.radius2 > b.radius2 || (a.radius2 == b.radius2 && geom::RestrictedPower::circle_before(a, b));
}

bool has_degenerate_facet(const geom::TriMesh& mesh) {
  for (std::size_t t = 0; t < mesh.num_facets(); ++t)
    if (geom::is_degenerate(mesh, geom::FacetId(t))) return true;
  return false;
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
      source_(make_source(options.engine, mesh.box())),
      diagram_(std::make_unique<geom::RestrictedPower>(mesh, *source_, options.corners)),
      circles_(CircleOrder{diagram_.get()}) {
  geom::require(!samples.empty(), "there must be at least one sample");
  std::vector<SiteId> order;
  for (std::size_t i = 0; i < samples.size(); ++i) order.emplace_back(i);
  geom::Rng(options.seed).shuffle(std::span(order));
  if (has_degenerate_facet(mesh))
    for (const SiteId x : order) insert(x, SiteId());
  else
    build(order);
}

/// All samples at once. `order`: in which they enter the source.
void SurfaceDomain::build(std::span<const SiteId> order) {
  std::vector<geom::WeightedPoint3> points;
  points.reserve(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i)
    points.push_back({samples_[SiteId(i)].position, weight_at(SiteId(i))});
  geom::SiteTree tree;
  const bool has_tree = options_.engine == Engine::search;
  for (const SiteId x : order) {
    source_->insert(x, points[x.index()], SiteId());
    if (!has_tree) tree.insert(x, points[x.index()]);
  }
  apply(diagram_->build(points, has_tree ? *source_ : tree, options_.threads));
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
  diagram_->expect(x, 4);
  for (int i = 0; i < 3; ++i)
    if (const SiteId y = expected_[static_cast<std::size_t>(i)]; y.valid()) diagram_->expect(y, 3 - i);
  expected_ = {x, expected_[0], expected_[1]};
}

double SurfaceDomain::separation(SiteId x) { return source_->nearest(samples_[x].position, x, x).radius2; }

// One move, forward only: the neighbour source, then the diagram, then the heap.

void SurfaceDomain::remove(SiteId x) {
  near_removed_ = SiteId();
  if (diagram_->fragments().of_cell(x).empty())
    near_removed_ = source_->nearest(samples_[x].position, x, x).site;
  source_->remove(x);
  apply(diagram_->after_remove(x));
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
    for (CircleId c = diagram_->first_circle(y); c.valid(); c = diagram_->next_circle(c, y))
      if (!best.valid() || larger(c, best)) best = c;
  };
  for (const SiteId y : last_change_->cells) look_around(y);
  if (last_change_->cells.empty() && near_removed_.valid()) look_around(near_removed_);
  return best.valid() ? Circle{diagram_->circle(best).radius2, best} : no_circle;
}

bool SurfaceDomain::larger(CircleId a, CircleId b) const {
  return larger_circle(diagram_->circle(a), diagram_->circle(b));
}

bool SurfaceDomain::is_farther(const Circle& c, SiteId x) {
  return is_farther(c.radius2, x, last_change_->cells);
}

/// First against the heirs of the removed cell; one that is nearest of all but no heir is rare.
bool SurfaceDomain::is_farther(double radius2, SiteId x, std::span<const SiteId> heirs) const {
  const geom::Vec3& place = samples_[x].position;
  for (const SiteId y : heirs)
    if (radius2 > geom::power(place, diagram_->site(y))) return true;
  return radius2 > source_->nearest(place, x, heirs.empty() ? near_removed_ : heirs.front()).radius2;
}

// --- a move at once ------------------------------------------------------------------------------

std::optional<bool> SurfaceDomain::move_directly(SiteId x, Scope scope) {
  std::optional<geom::RestrictedPower::Plan> plan = plan_removal(x, scope);
  const geom::EmptyCircle* const best = plan ? largest_planned(x, *plan, scope) : nullptr;
  const bool moves = best && is_farther(best->radius2, x, plan->heirs);
  if (moves)
    move_planned(x, *best);
  else
    stay(x);
  if (!best) return {};
  return moves;
}

std::optional<geom::RestrictedPower::Plan> SurfaceDomain::plan_removal(SiteId x, Scope scope) {
  source_->remove(x);
  std::optional<geom::RestrictedPower::Plan> plan = diagram_->plan_removal(x);
  if (plan && scope == Scope::two_ring) plan = diagram_->complete_plan(x);  // with all heirs
  return plan;
}

void SurfaceDomain::move_planned(SiteId x, const geom::EmptyCircle& circle) {
  samples_[x] = {circle.center, circle.facet};
  const geom::WeightedPoint3 point{samples_[x].position, weight_at(x)};
  source_->insert(x, point, circle.sites[0]);
  apply(diagram_->after_move(x, point));
}

void SurfaceDomain::stay(SiteId x) {
  SiteId hint;
  if (const CircleId c = diagram_->first_circle(x); c.valid())
    for (const SiteId y : diagram_->circle(c).sites)
      if (y != x) hint = y;
  source_->insert(x, diagram_->site(x), hint);
  diagram_->stay(x);
}

const geom::EmptyCircle* SurfaceDomain::largest_planned(SiteId x, geom::RestrictedPower::Plan& plan,
                                                        Scope scope) {
  const geom::EmptyCircle* best = nullptr;
  const auto consider = [&](const geom::EmptyCircle& circle) {
    if (!best || larger_circle(circle, *best)) best = &circle;
  };
  const auto touches_x = [&](const geom::EmptyCircle& circle) {
    return std::ranges::find(circle.sites, x) != circle.sites.end();
  };
  for (const geom::EmptyCircle& circle : plan.circles)
    if (scope == Scope::two_ring || is_offered(circle)) consider(circle);
  if (scope == Scope::two_ring) {
    for (const SiteId y : plan.heirs)
      for (CircleId c = diagram_->first_circle(y); c.valid(); c = diagram_->next_circle(c, y))
        if (!touches_x(diagram_->circle(c))) consider(diagram_->circle(c));
  } else if (!circles_.empty()) {
    consider(diagram_->circle(circles_.top().slot));
  }
  if (!plan.is_complete() && (!best || best->radius2 <= plan.complete_above)) {
    plan = diagram_->complete_plan(x);
    return largest_planned(x, plan, scope);
  }
  return best && !touches_x(*best) ? best : nullptr;
}

bool SurfaceDomain::is_offered(const geom::EmptyCircle& circle) const {
  return !options_.offers || options_.offers(circle, diagram_->site(circle.sites[0]));
}

void SurfaceDomain::insert_at(SiteId x, const Circle& c) {
  const geom::EmptyCircle& circle = diagram_->circle(c.id);
  samples_[x] = {circle.center, circle.facet};
  insert(x, circle.sites[0]);
}

void SurfaceDomain::insert_at(SiteId x, const SurfaceSample& place, double weight_share) {
  geom::ensure(weight_share >= 0, "the share of a weight must not be negative");
  samples_[x] = place;
  weight_share_[x] = weight_share;
  unweighted_ &= weight_share == 1;
  put_back(x);
}

void SurfaceDomain::put_back(SiteId x) {
  const std::vector<SiteId>& heirs = last_change_->cells;
  insert(x, heirs.empty() ? SiteId() : heirs.front());
}

void SurfaceDomain::insert(SiteId x, SiteId hint) {
  const geom::WeightedPoint3 point{samples_[x].position, weight_at(x)};
  source_->insert(x, point, hint);
  apply(diagram_->after_insert(x, point));
}

void SurfaceDomain::apply(const geom::RestrictedPower::Change& change) {
  for (const CircleId c : change.circles_erased)
    if (circles_.contains(c)) circles_.erase(c);
  for (const CircleId c : change.circles_created) {
    const geom::EmptyCircle& circle = diagram_->circle(c);
    if (is_offered(circle)) circles_.push(c, circle.radius2);
  }
  for (const CircleId c : change.circles_moved) {
    const geom::EmptyCircle& circle = diagram_->circle(c);
    const bool listed = circles_.contains(c), offered = is_offered(circle);
    if (listed && offered) circles_.update(c, circle.radius2);
    if (listed && !offered) circles_.erase(c);
    if (!listed && offered) circles_.push(c, circle.radius2);
  }
  last_change_ = &change;
}

double SurfaceDomain::normalized_spacing(SiteId x) {
  const double h = sizing_.at(samples_[x]);
  const geom::NeighbourSource::Nearest nearest = source_->nearest(samples_[x].position, x, x);
  if (!nearest.site.valid()) return std::numeric_limits<double>::infinity();
  double least2 = (samples_[nearest.site].position - samples_[x].position).squaredNorm();
  if (unweighted_) return std::sqrt(least2) / h;
  neighbours(x, link_);
  for (const SiteId y : link_)
    least2 = std::min(least2, (samples_[y].position - samples_[x].position).squaredNorm());
  return std::sqrt(least2) / h;
}

void SurfaceDomain::neighbours(SiteId x, std::vector<SiteId>& out) {
  diagram_->link(x, out);
  if (!out.empty() || num_samples() == 1) return;
  const SiteId hider = source_->nearest(samples_[x].position, x, x).site;
  if (hider.valid()) out.push_back(hider);
}

std::size_t SurfaceDomain::num_hidden() const {
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < num_samples(); ++i) hidden += diagram_->fragments().of_cell(SiteId(i)).empty();
  return hidden;
}

Localization SurfaceDomain::localize() {
  return fpo::localize(*diagram_, std::span<const SurfaceSample>(samples_.data(), samples_.size()));
}

void SurfaceDomain::check() const {
  diagram_->check();
  circles_.check();
}

}  // namespace fpo
