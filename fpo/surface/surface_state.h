#pragma once
// What a surface domain is made of: the samples, their diagram, and the circles that follow from it. Its
// steps (surface_domain.h) and a removal that is only planned (surface_removal.h) share it.

#include <memory>
#include <span>

#include "fpo/followers.h"
#include "fpo/surface/circle_heap.h"
#include "fpo/surface/move_guard.h"
#include "fpo/surface/weighted_samples.h"
#include "geom/dual/restricted_dual.h"

namespace fpo {

struct SurfaceState {
  /// All samples are in. Keeps references to the mesh and the guard. Cost and errors: those of SurfaceDomain.
  SurfaceState(const geom::TriMesh& mesh, WeightedSamples all, const SurfaceOptions& options,
               MoveGuard* guard);
  SurfaceState(const SurfaceState&) = delete;
  SurfaceState& operator=(const SurfaceState&) = delete;

  /// The site that the sample x would be at that place.
  geom::WeightedPoint3 point_at(const SurfaceSample& place, SiteId x) const;
  /// Of all others the nearest to it, in power.
  geom::NeighbourOracle::Nearest nearest_to(SiteId x) const;
  /// Has the circle a larger priority than the place of x, which is out or about to be? `heirs`: of its cell.
  bool is_farther(const geom::EmptyCircle& circle, SiteId x, std::span<const SiteId> heirs) const;

  /// Tells all that follow the dual what it has changed: first the heap.
  void apply(const geom::RestrictedDual::Change& change);

  WeightedSamples samples;
  MoveGuard* guard;                              ///< null: everything is allowed
  std::unique_ptr<geom::NeighbourOracle> paper;  ///< Engine::triangulation
  geom::RestrictedDual dual;
  CircleHeap circles;
  const geom::RestrictedDual::Change* last_change = nullptr;
  Followers<geom::RestrictedDual::Change> followers;
};

}  // namespace fpo
