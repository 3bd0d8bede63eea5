#pragma once
// Where integrals over a cell look at what is integrated.

#include <array>

#include "geom/power/facet_polygon.h"
#include "geom/vec.h"

namespace fpo {

/// Calls f(x, area) for the nodes of a polygon and the area that each stands for: the middles of the edges of
/// the triangles of a fan, each for a third of its triangle. Exact, up to rounding, for polynomials of degree
/// 2.
template <class F>
void each_node(const geom::FacetPolygon& polygon, F&& f) {
  for (std::size_t k = 1; k + 1 < polygon.corners.size(); ++k) {
    const geom::Vec3 &a = polygon.corners[0].point.position, &b = polygon.corners[k].point.position,
                     &c = polygon.corners[k + 1].point.position;
    const double third = (b - a).cross(c - a).norm() / 6;
    for (const geom::Vec3& x : {geom::Vec3((a + b) / 2), geom::Vec3((b + c) / 2), geom::Vec3((c + a) / 2)})
      f(x, third);
  }
}

}  // namespace fpo
