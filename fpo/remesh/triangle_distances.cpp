#include "fpo/remesh/triangle_distances.h"

#include <array>
#include <cmath>

#include "geom/mesh/scaling.h"

namespace fpo {

using geom::Vec3;

FarPoint TriangleDistances::farthest(const geom::EmptyCircle& circle, double enough) const {
  std::array<Vec3, 3> x;
  for (std::size_t i = 0; i < 3; ++i) x[i] = domain_.sample(circle.sites[i]).position;
  const std::array<Vec3, 4> middles{(x[0] + x[1]) / 2, (x[1] + x[2]) / 2, (x[2] + x[0]) / 2,
                                    (x[0] + x[1] + x[2]) / 3};
  FarPoint result{0, {circle.center, circle.facet}};
  const std::array<Vec3, 3> facet = tree_.triangle(circle.facet);
  for (const Vec3& middle : middles) {
    if (enough >= 0 && geom::closest_point(middle, facet).distance2 <= enough * enough) continue;
    const geom::AabbTree::Closest closest = tree_.closest(middle, circle.facet);
    if (closest.distance2 > result.distance * result.distance)
      result = {std::sqrt(closest.distance2), {geom::snapped(closest.point), closest.facet}};
  }
  return result;
}

std::vector<CircleId> triangles_of(const geom::RestrictedDual& dual) {
  std::vector<CircleId> triangles;
  for (std::size_t i = 0; i < dual.num_sites(); ++i)
    for (const CircleId c : dual.circles_of(SiteId(i))) {
      const geom::EmptyCircle& circle = dual.circle(c);
      if (circle.sites[0] == SiteId(i) && circle.sites[2].valid()) triangles.push_back(c);
    }
  return triangles;
}

}  // namespace fpo
