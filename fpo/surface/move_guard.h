#pragma once
// What a move on a surface may read and touch is the affair of those who share the surface (tile_domain.h):
// they hand in a guard, who is asked at the moments that matter.

#include "fpo/domain.h"
#include "geom/dual/empty_circles.h"

namespace fpo {

class SurfaceDomain;
class SurfaceRemoval;

enum class MoveOutcome {
  forbidden,  ///< by the guard: the sample is where it was
  stayed,     ///< the sample has the best place already
  moved
};

/// Asked in this order, each time whether the move may go on; if not, what has been done is undone.
class MoveGuard {
 public:
  MoveGuard() = default;
  MoveGuard(const MoveGuard&) = delete;
  MoveGuard& operator=(const MoveGuard&) = delete;
  virtual ~MoveGuard() = default;

  /// Line 5: the sample is out, or its removal is planned (surface_removal.h). May it leave its cell to the
  /// heirs, and may circles be looked for in scope? Asked again if a planned removal is carried out.
  virtual bool may_vacate(SurfaceRemoval& removal, Scope scope) = 0;
  /// Line 6: may the circle be the farthest point? `site`: the first of those that it touches. Asked when the
  /// circle comes into being, for then it enters the heap or never does, and before a sample goes there.
  virtual bool offers(const geom::EmptyCircle& circle, const geom::WeightedPoint3& site) const = 0;
  /// Line 7: x is where the circle was. May it keep what it has won?
  virtual bool may_keep(SurfaceDomain& domain, SiteId x, const geom::EmptyCircle& circle) = 0;
};

}  // namespace fpo
