#pragma once
// Vectors, boxes and weighted points.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace geom {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Box3 = Eigen::AlignedBox3d;

/// A sample with its weight (paper, section 3.1): the disk of squared radius `weight` about `position`.
struct WeightedPoint2 {
  Vec2 position;
  double weight = 0;
};
struct WeightedPoint3 {
  Vec3 position;
  double weight = 0;
  double level = 0;  ///< a fourth coordinate, as locations of the surface have one (levels.h)
};
/// A location of the surface and its level.
struct Location3 {
  const Vec3& position;
  double level;
  Location3(const Vec3& position, double level = 0) : position(position), level(level) {}
};

/// Power of the unweighted location x with respect to p (paper, equation 1): |x - p|^2 - w. Rounded. Of a
/// place without a level: as if it had that of p.
inline double power(const Vec3& x, const WeightedPoint3& p) {
  return (x - p.position).squaredNorm() - p.weight;
}
inline double power(const Location3& x, const WeightedPoint3& p) {
  const double rise = x.level - p.level;
  return (x.position - p.position).squaredNorm() + rise * rise - p.weight;
}
inline double power(const Vec2& x, const WeightedPoint2& p) {
  return (x - p.position).squaredNorm() - p.weight;
}

}  // namespace geom
