#pragma once
// Distances of many points from one triangle.

#include <algorithm>
#include <array>

#include "geom/mesh/aabb_tree.h"

namespace geom {

/// By the region of the triangle that a point is nearest to: a corner, an edge or the inside. What
/// closest_point() gives, up to rounding, in a fifth of its time. A triangle without area is its edges.
class DistanceFromTriangle {
 public:
  explicit DistanceFromTriangle(const std::array<Vec3, 3>& corners)
      : corners_(corners),
        ab_(corners[1] - corners[0]),
        ac_(corners[2] - corners[0]),
        normal_(ab_.cross(ac_)),
        ab_ab_(ab_.squaredNorm()),
        ab_ac_(ab_.dot(ac_)),
        ac_ac_(ac_.squaredNorm()),
        normal2_(normal_.squaredNorm()),
        is_fat_(normal2_ > 1e-6 * (ab_ab_ + ac_ac_) * (ab_ab_ + ac_ac_)) {}

  /// distance2() <= limit2 up to rounding, sooner where that is not so.
  bool is_within(const Vec3& x, double limit2) const {
    return !(is_fat_ && is_beyond_a_side(x, limit2)) && distance2(x) <= limit2;
  }

  /// An upper bound of the squared distance of two of its points.
  double diameter2() const { return std::max({ab_ab_, ac_ac_, ab_ab_ - 2 * ab_ac_ + ac_ac_}) * (1 + 1e-9); }

  /// Squared.
  double distance2(const Vec3& x) const {
    if (!(normal2_ > 0)) return closest_point(x, corners_).distance2;
    const Vec3 ax = x - corners_[0];
    const double b_at_a = ab_.dot(ax), c_at_a = ac_.dot(ax);
    if (b_at_a <= 0 && c_at_a <= 0) return ax.squaredNorm();
    const double b_at_b = b_at_a - ab_ab_, c_at_b = c_at_a - ab_ac_;
    if (b_at_b >= 0 && c_at_b <= b_at_b) return (x - corners_[1]).squaredNorm();
    if (b_at_a * c_at_b <= b_at_b * c_at_a && b_at_a >= 0 && b_at_b <= 0)
      return (ax - (b_at_a / ab_ab_) * ab_).squaredNorm();
    const double b_at_c = b_at_a - ab_ac_, c_at_c = c_at_a - ac_ac_;
    if (c_at_c >= 0 && b_at_c <= c_at_c) return (x - corners_[2]).squaredNorm();
    if (b_at_c * c_at_a <= b_at_a * c_at_c && c_at_a >= 0 && c_at_c <= 0)
      return (ax - (c_at_a / ac_ac_) * ac_).squaredNorm();
    const double from_b = c_at_b - b_at_b, from_c = b_at_c - c_at_c;
    if (b_at_b * c_at_c <= b_at_c * c_at_b && from_b >= 0 && from_c >= 0)
      return (x - corners_[1] - from_b / (from_b + from_c) * (corners_[2] - corners_[1])).squaredNorm();
    const double height = normal_.dot(ax);
    return height * height / normal2_;
  }

 private:
  /// In its plane, by more than that: over the side and its length, twice the area of the triangle of x and
  /// the side is the distance, here times twice the triangle's own area. Rounding of these products, of some
  /// 1e-16 L^4 for the longest side L, is a share of 1e-16 (L / w)^2 of what is compared at a side w.
  bool is_beyond_a_side(const Vec3& x, double limit2) const {
    const Vec3 ax = x - corners_[0];
    const double b_at_a = ab_.dot(ax), c_at_a = ac_.dot(ax);
    const double b_at_b = b_at_a - ab_ab_, c_at_b = c_at_a - ab_ac_;
    const double b_at_c = b_at_a - ab_ac_, c_at_c = c_at_a - ac_ac_;
    const double far2 = limit2 * normal2_ * (1 + 1e-9);
    const double beyond_ab = b_at_b * c_at_a - b_at_a * c_at_b;
    if (beyond_ab > 0 && beyond_ab * beyond_ab > far2 * ab_ab_) return true;
    const double beyond_ac = b_at_a * c_at_c - b_at_c * c_at_a;
    if (beyond_ac > 0 && beyond_ac * beyond_ac > far2 * ac_ac_) return true;
    const double beyond_bc = b_at_c * c_at_b - b_at_b * c_at_c;
    return beyond_bc > 0 && beyond_bc * beyond_bc > far2 * (ab_ab_ - 2 * ab_ac_ + ac_ac_);
  }

  std::array<Vec3, 3> corners_;
  Vec3 ab_, ac_, normal_;
  double ab_ab_, ab_ac_, ac_ac_, normal2_;
  bool is_fat_;  ///< its heights are above about 1e-3 of its longest side
};

}  // namespace geom
