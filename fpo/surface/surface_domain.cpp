#include "fpo/surface/surface_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fpo/surface/surface_removal.h"

namespace fpo {

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, WeightedSamples samples,
                             const SurfaceOptions& options, MoveGuard* guard)
    : options_(options), state_(std::make_unique<SurfaceState>(mesh, std::move(samples), options, guard)) {
  options_.known = {};
}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing,
                             std::span<const SurfaceSample> samples, const SurfaceOptions& options,
                             MoveGuard* guard)
    : SurfaceDomain(mesh, WeightedSamples(sizing, samples, options), options, guard) {}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const SurfaceOptions& options)
    : SurfaceDomain(mesh, Sizing::uniform(hexagonal_spacing(mesh.area(), samples.size())), samples, options) {
}

SurfaceDomain SurfaceDomain::rebuilt() const {
  return SurfaceDomain(mesh(), samples().copy(), options_, state_->guard);
}

std::unique_ptr<geom::RestrictedPower> SurfaceDomain::diagram() const {
  std::vector<geom::WeightedPoint3> points;
  points.reserve(num_samples());
  for (std::size_t i = 0; i < num_samples(); ++i) points.push_back(dual().site(SiteId(i)));
  return std::make_unique<geom::RestrictedPower>(mesh(), points, dual().tree(), options_.threads);
}

// --- one move, forward only ----------------------------------------------------------------------

MoveOutcome SurfaceDomain::try_move(SiteId x, Scope scope) {
  MoveGuard* const guard = state_->guard;
  const SurfaceSample old = sample(x);
  SurfaceRemoval removal(*this, *state_, x);  // line 5
  const auto may_vacate = [&] { return !guard || guard->may_vacate(removal, scope); };
  bool allowed = may_vacate();
  if (allowed && !removal.find_largest(scope)) {  // line 6
    removal.carry_out();
    allowed = may_vacate() && removal.find_largest(scope);
  }
  const geom::EmptyCircle* farthest = removal.largest();
  if (!allowed) return removal.cancel(), MoveOutcome::forbidden;
  if (!farthest || !state_->is_farther(*farthest, x, removal.heirs()))
    return removal.cancel(), MoveOutcome::stayed;  // line 9
  const geom::EmptyCircle circle = *farthest;
  if (!state_->circles.is_offered(circle)) return removal.cancel(), MoveOutcome::forbidden;
  removal.insert();  // line 7
  if (!guard || guard->may_keep(*this, x, circle)) return MoveOutcome::moved;
  remove(x);
  insert_at(x, old, weight_share(x));
  return MoveOutcome::forbidden;
}

// --- its steps, and those of everybody else, each by itself -----------------------------------------

void SurfaceDomain::remove(SiteId x) {
  near_removed_ = SiteId();
  if (!dual().has_cell(x)) near_removed_ = state_->nearest_to(x).site;
  state_->apply(state_->dual.remove(x));
}

/// The two rings: the circles on the cells of the removed sample's neighbours.
Circle SurfaceDomain::largest_empty(Scope scope) {
  std::span<const SiteId> around = last_change().cells;
  if (around.empty() && near_removed_.valid()) around = {&near_removed_, 1};
  CircleHeap& circles = state_->circles;
  const CircleId found = scope == Scope::global ? circles.top() : circles.first_on(around);
  if (!found.valid()) return {-std::numeric_limits<double>::infinity(), found};
  return {dual().circle(found).radius2, found};
}

bool SurfaceDomain::is_farther(const Circle& c, SiteId x) {
  return c.id.valid() && state_->is_farther(dual().circle(c.id), x, last_change().cells);
}

void SurfaceDomain::insert_at(SiteId x, const Circle& c) {
  const geom::EmptyCircle& circle = dual().circle(c.id);
  insert(x, {circle.center, circle.facet}, c.id);
}

void SurfaceDomain::insert_at(SiteId x, const SurfaceSample& place, double weight_share) {
  state_->samples.set_share(x, weight_share);
  insert(x, place);
}

void SurfaceDomain::put_back(SiteId x) { insert(x, sample(x)); }

void SurfaceDomain::insert(SiteId x, const SurfaceSample& place, CircleId at) {
  const auto& change = state_->dual.insert(x, state_->point_at(place, x), place.facet, at);
  state_->samples.put(x, place);
  state_->apply(change);
}

// --- what else is asked ------------------------------------------------------------------------------

double SurfaceDomain::normalized_spacing(SiteId x) {
  const double h = sizing().at(sample(x));
  const SiteId nearest = state_->nearest_to(x).site;
  if (!nearest.valid()) return std::numeric_limits<double>::infinity();
  const auto distance2 = [&](SiteId y) { return (sample(y).position - sample(x).position).squaredNorm(); };
  double least2 = distance2(nearest);
  if (samples().have_no_weights() && !mesh().has_levels()) return std::sqrt(least2) / h;
  neighbours(x, link_);
  for (const SiteId y : link_) least2 = std::min(least2, distance2(y));
  return std::sqrt(least2) / h;
}

void SurfaceDomain::neighbours(SiteId x, std::vector<SiteId>& out) {
  dual().link(x, out);
  if (!out.empty() || num_samples() == 1) return;
  const SiteId hider = state_->nearest_to(x).site;
  if (hider.valid()) out.push_back(hider);
}

void SurfaceDomain::expect(SiteId x) {
  expected_.announce(x, [this](SiteId y, int calls) { dual().expect(y, calls); });
}

void SurfaceDomain::shrink() {
  state_->circles.forget();
  state_->dual.shrink();
}

std::size_t SurfaceDomain::num_hidden() const {
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < num_samples(); ++i) hidden += !dual().has_cell(SiteId(i));
  return hidden;
}

void SurfaceDomain::check() const {
  dual().check();
  state_->circles.check();
}

}  // namespace fpo
