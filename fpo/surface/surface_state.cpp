#include "fpo/surface/surface_state.h"

#include <utility>
#include <vector>

#include "geom/mesh/scaling.h"
#include "geom/rng.h"
#include "geom/sites/triangulation_oracle.h"

namespace fpo {
namespace {

/// Levels leave the search alone.
std::unique_ptr<geom::NeighbourOracle> make_oracle(Engine engine, const geom::TriMesh& mesh) {
  if (engine == Engine::search || mesh.has_levels()) return nullptr;
  return std::make_unique<geom::TriangulationOracle>(mesh.box());
}

}  // namespace

SurfaceState::SurfaceState(const geom::TriMesh& mesh, WeightedSamples all, const SurfaceOptions& options,
                           MoveGuard* guard)
    : samples(std::move(all)),
      guard(guard),
      paper(make_oracle(options.engine, mesh)),
      dual(mesh, options.corners, paper.get()),
      circles(dual, {options.farthest, samples.sizing()}, guard) {
  std::vector<SiteId> order;
  std::vector<geom::WeightedPoint3> points;
  std::vector<geom::FacetId> homes;
  order.reserve(samples.size());
  points.reserve(samples.size());
  homes.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    order.emplace_back(i);
    points.push_back(point_at(samples[SiteId(i)], SiteId(i)));
    homes.push_back(samples[SiteId(i)].facet);
  }
  geom::Rng(options.seed).shuffle(std::span(order));
  samples.follow(dual.sites());
  apply(dual.build(std::move(points), homes, order, options.threads, options.known));
}

geom::WeightedPoint3 SurfaceState::point_at(const SurfaceSample& place, SiteId x) const {
  const double weight = samples.weight_at(place, x);
  if (!dual.mesh().has_levels()) return {place.position, weight};
  const double level = dual.level_at(place.facet, place.position);
  return {place.position, weight, geom::snapped(level, geom::coordinate_unit)};
}

geom::NeighbourOracle::Nearest SurfaceState::nearest_to(SiteId x) const {
  return dual.nearest({samples[x].position, dual.site(x).level}, x);
}

/// First against the heirs; one that is nearest of all but no heir is rare.
bool SurfaceState::is_farther(const geom::EmptyCircle& circle, SiteId x,
                              std::span<const SiteId> heirs) const {
  const SurfaceSample home = samples[x];
  const geom::Location3 place(home.position, dual.site(x).level);
  const double most = circles.priority()(circle);
  const auto is_nearer = [&](double radius2) { return most > circles.priority()(home, radius2); };
  for (const SiteId y : heirs)
    if (is_nearer(geom::power(place, dual.site(y)))) return true;
  return is_nearer(dual.nearest(place, x).radius2);
}

void SurfaceState::apply(const geom::RestrictedDual::Change& change) {
  circles.apply(change);
  last_change = &change;
  followers.tell(change);
}

}  // namespace fpo
