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
};

/// Power of the unweighted location x with respect to p (paper, equation 1): |x - p|^2 - w. Rounded.
inline double power(const Vec3& x, const WeightedPoint3& p) {
  return (x - p.position).squaredNorm() - p.weight;
}
inline double power(const Vec2& x, const WeightedPoint2& p) {
  return (x - p.position).squaredNorm() - p.weight;
}

}  // namespace geom
