#pragma once
// How far the RRT's triangles are from the surface.

#include <vector>

#include "fpo/surface/surface_domain.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

struct FarPoint {
  double distance = 0;  ///< in the units of the surface
  SurfaceSample at{};   ///< on the surface
};

/// At the middles of their edges and at their own. Keeps a reference to the domain and a tree of its surface.
class TriangleDistances {
 public:
  explicit TriangleDistances(const SurfaceDomain& domain) : domain_(domain), tree_(domain.mesh()) {}

  const geom::AabbTree& tree() const { return tree_; }

  /// The point of the surface below the point of the triangle that is farthest from it, those left out that
  /// the circle's facet shows to be no farther than `enough`: mostly it does, and saves a search.
  FarPoint farthest(const geom::EmptyCircle& circle, double enough = -1) const;

 private:
  const SurfaceDomain& domain_;
  geom::AabbTree tree_;
};

/// Each circle of type C once, by the first of its sites.
std::vector<CircleId> triangles_of(const geom::RestrictedDual& dual);
template <class Visit>
void for_triangles(const geom::RestrictedDual& dual, Visit visit) {
  for (const CircleId c : triangles_of(dual)) visit(dual.circle(c));
}

}  // namespace fpo
