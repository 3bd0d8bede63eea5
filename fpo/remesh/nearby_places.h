#pragma once
// Where a sample may be tried instead: places on the surface on small circles about it.

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "fpo/surface/surface_sample.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

struct CirclesAbout {
  double unit;  ///< of the radii
  std::span<const double> radii;
  int directions;
  double first = 0;  ///< direction
};

/// In the plane of its facet, then the nearest on the tree's surface, circle after circle; none if the facet
/// has no area.
inline std::vector<SurfaceSample> nearby_places(const geom::TriMesh& surface, const geom::AabbTree& tree,
                                                const SurfaceSample& x, const CirclesAbout& circles) {
  std::vector<SurfaceSample> places;
  const geom::Vec3 normal = surface.normal(x.facet).normalized();
  if (normal.isZero()) return places;
  const geom::Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  for (const double radius : circles.radii)
    for (int k = 0; k < circles.directions; ++k) {
      const double angle = circles.first + 2 * std::numbers::pi * k / circles.directions;
      const geom::Vec3 away =
          x.position + radius * circles.unit * (std::cos(angle) * u + std::sin(angle) * v);
      const geom::AabbTree::Closest closest = tree.closest(away, x.facet);
      places.push_back({geom::snapped(closest.point), closest.facet});
    }
  return places;
}

}  // namespace fpo
