#include "fpo/surface/surface_domain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fpo/surface/surface_removal.h"
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

}  // namespace

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const SurfaceOptions& options)
    : SurfaceDomain(mesh, Sizing::uniform(hexagonal_spacing(mesh.area(), samples.size())), samples, options) {
}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing,
                             std::span<const SurfaceSample> samples, const SurfaceOptions& options,
                             MoveGuard* guard)
    : SurfaceDomain(mesh, sizing, {samples, geom::Table<SiteId, double>(samples.size(), 1.0)}, options,
                    guard) {}

SurfaceDomain SurfaceDomain::rebuilt() const {
  return SurfaceDomain(mesh_, sizing_, {std::span(samples_.data(), samples_.size()), weight_share_}, options_,
                       guard_);
}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing, Start start,
                             const SurfaceOptions& options, MoveGuard* guard)
    : mesh_(mesh),
      sizing_(sizing),
      options_(options),
      guard_(guard),
      samples_(start.samples.begin(), start.samples.end()),
      weight_share_(std::move(start.weight_shares)),
      unweighted_(equal_weights() && std::ranges::count(weight_share_, 1.0) == std::ssize(weight_share_)),
      paper_(mesh.has_levels() ? nullptr : make_source(options.engine, mesh.box())),
      dual_(std::make_unique<geom::RestrictedDual>(mesh, options.corners, paper_.get())),
      circles_(CircleOrder{dual_.get()}) {
  geom::require(!samples_.empty(), "there must be at least one sample");
  std::vector<SiteId> order;
  for (std::size_t i = 0; i < samples_.size(); ++i) order.emplace_back(i);
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

// --- the farthest point --------------------------------------------------------------------------

bool SurfaceDomain::goes_before(const geom::EmptyCircle& a, const geom::EmptyCircle& b) const {
  const double of_a = priority(a), of_b = priority(b);
  return of_a > of_b || (of_a == of_b && circle_before(a, b));
}

// --- one move, forward only ----------------------------------------------------------------------

MoveOutcome SurfaceDomain::try_move(SiteId x, Scope scope) {
  const SurfaceSample old = samples_[x];
  SurfaceRemoval removal(*this, x);  // line 5
  const auto may_vacate = [&] { return !guard_ || guard_->may_vacate(removal, scope); };
  bool allowed = may_vacate();
  if (allowed && !removal.find_largest(scope)) {  // line 6
    removal.carry_out();
    allowed = may_vacate() && removal.find_largest(scope);
  }
  const geom::EmptyCircle* farthest = removal.largest();
  if (!allowed) return removal.cancel(), MoveOutcome::forbidden;
  if (!farthest || !is_farther(*farthest, x, removal.heirs()))
    return removal.cancel(), MoveOutcome::stayed;  // line 9
  const geom::EmptyCircle circle = *farthest;
  if (!is_offered(circle)) return removal.cancel(), MoveOutcome::forbidden;
  removal.insert();  // line 7
  if (!guard_ || guard_->may_keep(*this, x, circle)) return MoveOutcome::moved;
  remove(x);
  insert_at(x, old, weight_share_[x]);
  return MoveOutcome::forbidden;
}

// Its steps, and those of everybody else, each by itself: the neighbour source, then the diagram, then the
// heap.

void SurfaceDomain::remove(SiteId x) {
  near_removed_ = SiteId();
  if (!dual_->has_cell(x)) near_removed_ = nearest_to(x).site;
  apply(dual_->remove(x));
}

Circle SurfaceDomain::largest_empty(Scope scope) {
  if (scope == Scope::two_ring) return largest_in_two_ring();
  if (circles_.empty()) return no_circle;
  const CircleId top = circles_.top().slot;
  return {dual_->circle(top).radius2, top};
}

/// Among the circles on the cells of the removed sample's neighbours: two rings of the RRT around it.
Circle SurfaceDomain::largest_in_two_ring() {
  CircleId best;
  const auto look_around = [&](SiteId y) {
    for (const CircleId c : dual_->circles_of(y))
      if (!best.valid() || goes_before(dual_->circle(c), dual_->circle(best))) best = c;
  };
  for (const SiteId y : last_change_->cells) look_around(y);
  if (last_change_->cells.empty() && near_removed_.valid()) look_around(near_removed_);
  return best.valid() ? Circle{dual_->circle(best).radius2, best} : no_circle;
}

bool SurfaceDomain::is_farther(const Circle& c, SiteId x) {
  return c.id.valid() && is_farther(dual_->circle(c.id), x, last_change_->cells);
}

/// First against the heirs of the removed cell; one that is nearest of all but no heir is rare.
bool SurfaceDomain::is_farther(const geom::EmptyCircle& c, SiteId x, std::span<const SiteId> heirs) const {
  const SurfaceSample& home = samples_[x];
  const geom::Location3 place(home.position, dual_->site(x).level);
  const double most = priority(c);
  const auto is_nearer = [&](double radius2) { return most > priority(home, radius2); };
  for (const SiteId y : heirs)
    if (is_nearer(geom::power(place, dual_->site(y)))) return true;
  return is_nearer(dual_->nearest(place, x).radius2);
}

bool SurfaceDomain::is_offered(const geom::EmptyCircle& circle) const {
  return !guard_ || guard_->offers(circle, dual_->site(circle.sites[0]));
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
    if (is_offered(circle)) circles_.push(c, priority(circle));
  }
  for (const CircleId c : change.circles_moved) {
    const geom::EmptyCircle& circle = dual_->circle(c);
    const bool listed = circles_.contains(c), offered = is_offered(circle);
    if (listed && offered) circles_.update(c, priority(circle));
    if (listed && !offered) circles_.erase(c);
    if (!listed && offered) circles_.push(c, priority(circle));
  }
  last_change_ = &change;
  followers_.tell(change);
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
