#pragma once
// The room above and below a triangle of the remesh.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "geom/vec.h"

namespace fpo {

/// Over the triangle and some of its heights around it, as high above and below as its longest edge.
class Prism {
 public:
  static constexpr double most_margin = 0.6;
  /// A margin in longest edges. Let two planes meet in a side, with an angle phi between their normals. What
  /// is nearer to the one is beyond the side by at most tan(phi / 2) times its height over that one, here at
  /// most a longest edge. Around corners there are more than two: a fifth and .05 more are by trial
  /// (closeness_test). `cosine`: the least one of phi, of all triangles beside it.
  static double margin_beside(double cosine) {
    constexpr double least = 0.05, more = 1.2;
    return cosine > 0 ? least + more * std::sqrt((1 - cosine) / (1 + cosine)) : most_margin;
  }

  /// None over a triangle without area. `up`: to the side where its surface's normals point. `margin`: around
  /// it, in its longest edge, but no more than most_margin of its heights.
  static std::optional<Prism> over(const std::array<geom::Vec3, 3>& corners, const geom::Vec3& up,
                                   double margin) {
    geom::Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double area2 = normal.norm();
    if (!(area2 > 0) || up.isZero()) return {};
    normal /= area2;
    if (normal.dot(up) < 0) normal = -normal;
    return Prism(corners, normal, area2, margin);
  }

  const geom::Vec3& up() const { return up_; }

  /// How far within each side a point is, in units of the side's own; negative: outside.
  using Depths = std::array<double, 5>;
  Depths depths(const geom::Vec3& x) const {
    Depths result;
    for (std::size_t i = 0; i < sides_.size(); ++i) result[i] = sides_[i].inside(x);
    return result;
  }

  /// The share [from, to] of a segment that lies within, by the depths of its ends.
  static std::optional<std::pair<double, double>> share(const Depths& a, const Depths& b) {
    double from = 0, to = 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] < 0 && b[i] < 0) return {};
      if (a[i] < 0) from = std::max(from, a[i] / (a[i] - b[i]));
      if (b[i] < 0) to = std::min(to, a[i] / (a[i] - b[i]));
    }
    if (from > to) return {};
    return std::pair(from, to);
  }

 private:
  struct Side {
    geom::Vec3 inward;
    double offset;
    double inside(const geom::Vec3& x) const { return inward.dot(x) + offset; }
  };

  Prism(const std::array<geom::Vec3, 3>& corners, const geom::Vec3& up, double area2, double margin)
      : up_(up) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest, (corners[i] - corners[(i + 1) % 3]).norm());
    for (std::size_t i = 0; i < 3; ++i) {
      const geom::Vec3 &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
      geom::Vec3 inward = up.cross(b - a) / area2;  // 1 more at corner i than along the edge
      if (inward.dot(corners[i] - a) < 0) inward = -inward;
      const double heights = margin * longest * inward.norm();
      sides_[i] = {inward, std::min(heights, most_margin) - inward.dot(a)};
    }
    sides_[3] = {up, longest - up.dot(corners[0])};
    sides_[4] = {-up, longest + up.dot(corners[0])};
  }

  geom::Vec3 up_;
  std::array<Side, 5> sides_;
};

}  // namespace fpo
