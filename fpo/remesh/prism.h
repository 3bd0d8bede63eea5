#pragma once
// The room above and below a triangle of the remesh.

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "geom/vec.h"

namespace fpo {

/// Over the triangle and some of its heights around it, as high above and below as its longest edge.
class Prism {
 public:
  /// None over a triangle without area. `up`: to the side where its surface's normals point.
  static std::optional<Prism> over(const std::array<geom::Vec3, 3>& corners, const geom::Vec3& up) {
    geom::Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double area2 = normal.norm();
    if (!(area2 > 0) || up.isZero()) return {};
    normal /= area2;
    if (normal.dot(up) < 0) normal = -normal;
    return Prism(corners, normal, area2);
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
  static constexpr double margin = 0.6;  ///< in heights: prisms of neighbours leave wedges between them

  struct Side {
    geom::Vec3 inward;
    double offset;
    double inside(const geom::Vec3& x) const { return inward.dot(x) + offset; }
  };

  Prism(const std::array<geom::Vec3, 3>& corners, const geom::Vec3& up, double area2) : up_(up) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const geom::Vec3 &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
      geom::Vec3 inward = up.cross(b - a) / area2;  // 1 more at corner i than along the edge
      if (inward.dot(corners[i] - a) < 0) inward = -inward;
      sides_[i] = {inward, margin - inward.dot(a)};
      longest = std::max(longest, (b - a).norm());
    }
    sides_[3] = {up, longest - up.dot(corners[0])};
    sides_[4] = {-up, longest + up.dot(corners[0])};
  }

  geom::Vec3 up_;
  std::array<Side, 5> sides_;
};

}  // namespace fpo
