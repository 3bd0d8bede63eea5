#include "fpo/surface_domain.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geom/check.h"
#include "geom/rng.h"
#include "geom/site_tree.h"
#include "geom/triangulation_source.h"

namespace fpo {
namespace {

std::unique_ptr<geom::NeighbourSource> make_source(Engine engine, const geom::Box3& box) {
  if (engine == Engine::search) return std::make_unique<geom::SiteTree>();
  return std::make_unique<geom::TriangulationSource>(box);
}

}  // namespace

double hexagonal_spacing(double area, std::size_t n) {
  return std::sqrt(2 * area / (std::numbers::sqrt3 * static_cast<double>(n)));
}

SurfaceDomain::SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                             const SurfaceOptions& options)
    : mesh_(mesh),
      samples_(samples.begin(), samples.end()),
      hexagonal_spacing_(hexagonal_spacing(mesh.area(), samples.size())),
      neighbours_(make_source(options.engine, mesh.box())),
      diagram_(std::make_unique<geom::RestrictedPower>(mesh, *neighbours_, options.corners)),
      circles_(CircleOrder{diagram_.get()}) {
  geom::require(!samples.empty(), "there must be at least one sample");
  std::vector<SiteId> order;
  for (std::size_t i = 0; i < samples.size(); ++i) order.emplace_back(i);
  geom::Rng(options.seed).shuffle(std::span(order));
  for (const SiteId x : order) insert(x, SiteId());
}

double SurfaceDomain::separation(SiteId x) {
  return neighbours_->nearest(samples_[x].position, x, x).radius2;
}

// One move, forward only: the neighbour source, then the diagram, then the heap.

void SurfaceDomain::remove(SiteId x) {
  neighbours_->remove(x);
  apply(diagram_->after_remove(x));
}

Circle SurfaceDomain::largest_empty(Scope scope) {
  geom::ensure(scope == Scope::global, "the local scope on surfaces does not exist yet");
  if (circles_.empty()) return {-std::numeric_limits<double>::infinity(), CircleId()};
  return {circles_.top().key, circles_.top().slot};
}

void SurfaceDomain::insert_at(SiteId x, const Circle& c) {
  const geom::EmptyCircle& circle = diagram_->circle(c.id);
  samples_[x] = {circle.center, circle.facet};
  insert(x, circle.sites[0]);
}

void SurfaceDomain::put_back(SiteId x) {
  const std::vector<SiteId>& heirs = last_change_->cells;
  insert(x, heirs.empty() ? SiteId() : heirs.front());
}

void SurfaceDomain::insert(SiteId x, SiteId hint) {
  const geom::WeightedPoint3 point{samples_[x].position, 0};
  neighbours_->insert(x, point, hint);
  apply(diagram_->after_insert(x, point));
}

void SurfaceDomain::apply(const geom::RestrictedPower::Change& change) {
  for (const CircleId c : change.circles_erased) circles_.erase(c);
  for (const CircleId c : change.circles_created) circles_.push(c, diagram_->circle(c).radius2);
  last_change_ = &change;
}

double SurfaceDomain::normalized_spacing(SiteId x) { return std::sqrt(separation(x)) / hexagonal_spacing_; }

Localization SurfaceDomain::localize() {
  return fpo::localize(*diagram_, std::span<const SurfaceSample>(samples_.data(), samples_.size()));
}

void SurfaceDomain::check() const {
  diagram_->check();
  circles_.check();
}

}  // namespace fpo
