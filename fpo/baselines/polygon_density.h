#pragma once
// The wanted density of samples on a polygon of the diagram, and integrals of it.

#include <vector>

#include "fpo/surface/sizing.h"
#include "geom/power/facet_polygon.h"

namespace fpo {

/// (h_0 / h)^2, or 1 if the sizing is uniform. h is taken at the corners, and linear between them, as it is
/// on a facet.
class PolygonDensity {
 public:
  /// h_0 = unit_length. Keeps a reference to the polygon.
  PolygonDensity(const Sizing& sizing, double unit_length, const geom::FacetPolygon& polygon)
      : polygon_(polygon), unit_length_(unit_length) {
    if (sizing.is_uniform()) return;
    lengths_.reserve(polygon.corners.size());
    for (const geom::PolygonCorner& corner : polygon.corners)
      lengths_.push_back(sizing.at(SurfaceSample{corner.point.position, polygon.facet}));
  }

  /// At corner k.
  double at(std::size_t k) const { return lengths_.empty() ? 1 : density(lengths_[k]); }
  /// In the middle between corners i and k.
  double between(std::size_t i, std::size_t k) const {
    return lengths_.empty() ? 1 : density((lengths_[i] + lengths_[k]) / 2);
  }

  /// Calls f(x, area, density) for locations x whose areas add up to that of the polygon: the rule of edge
  /// midpoints on triangles from corner 0, exact for polynomials of degree 2.
  template <class F>
  void each_location(const F& f) const {
    const auto at = [&](std::size_t k) -> const geom::Vec3& { return polygon_.corners[k].point.position; };
    for (std::size_t k = 1; k + 1 < polygon_.corners.size(); ++k) {
      const double third = (at(k) - at(0)).cross(at(k + 1) - at(0)).norm() / 6;
      f(geom::Vec3((at(0) + at(k)) / 2), third, between(0, k));
      f(geom::Vec3((at(k) + at(k + 1)) / 2), third, between(k, k + 1));
      f(geom::Vec3((at(k + 1) + at(0)) / 2), third, between(k + 1, 0));
    }
  }

 private:
  double density(double h) const { return unit_length_ / h * (unit_length_ / h); }

  const geom::FacetPolygon& polygon_;
  double unit_length_;
  std::vector<double> lengths_;  ///< empty: all the same
};

}  // namespace fpo
