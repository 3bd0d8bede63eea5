#include "io/polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geom/exact/predicates.h"

namespace io {

using geom::Vec2;
using geom::Vec3;

namespace {

/// The polygon scaled by a power of two to a size at which no product of lengths under- or overflows.
std::vector<Vec3> at_unit_size(std::span<const Vec3> polygon) {
  double largest = 0;
  for (const Vec3& p : polygon) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(largest, &exponent);
  std::vector<Vec3> result;
  result.reserve(polygon.size());
  for (const Vec3& p : polygon)
    result.push_back(p.unaryExpr([&](double x) { return std::ldexp(x, -exponent); }));
  return result;
}

/// Twice the polygon's vector area (Newell), about its first corner.
Vec3 vector_area(std::span<const Vec3> polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return sum;
}

/// The polygon without the coordinate along which its area is largest; counterclockwise if its area is not 0.
std::vector<Vec2> project(std::span<const Vec3> polygon) {
  const Vec3 area = vector_area(polygon);
  int dropped = 0;
  area.cwiseAbs().maxCoeff(&dropped);
  int u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  if (area[dropped] < 0) std::swap(u, v);
  std::vector<Vec2> flat;
  flat.reserve(polygon.size());
  for (const Vec3& p : polygon) flat.emplace_back(p[u], p[v]);
  return flat;
}

/// A polygon that loses one corner at a time. A corner is convex if the boundary turns left there.
class ShrinkingPolygon {
 public:
  explicit ShrinkingPolygon(std::vector<Vec2> corners)
      : corners_(std::move(corners)), next_(corners_.size()), previous_(corners_.size()) {
    const int n = static_cast<int>(corners_.size());
    for (int i = 0; i < n; ++i) {
      next_[static_cast<std::size_t>(i)] = (i + 1) % n;
      previous_[static_cast<std::size_t>((i + 1) % n)] = i;
    }
    for (int i = 0; i < n; ++i)
      if (!is_convex(i)) blockers_.push_back(i);
  }

  int next(int i) const { return next_[static_cast<std::size_t>(i)]; }
  int previous(int i) const { return previous_[static_cast<std::size_t>(i)]; }

  /// Corner i can be cut off: it is convex and its triangle holds no other corner. Only a corner that is not
  /// convex can be the innermost one in there.
  bool is_ear(int i) const {
    if (!is_convex(i)) return false;
    const Vec2 &a = at(previous(i)), &b = at(i), &c = at(next(i));
    for (const int j : blockers_) {
      const Vec2& p = at(j);
      if (j == previous(i) || j == next(i) || p == a || p == b || p == c) continue;
      if (geom::orient2(a, b, p) >= 0 && geom::orient2(b, c, p) >= 0 && geom::orient2(c, a, p) >= 0)
        return false;
    }
    return true;
  }

  void cut(int i) {
    next_[static_cast<std::size_t>(previous(i))] = next(i);
    previous_[static_cast<std::size_t>(next(i))] = previous(i);
    if (!blockers_.empty())
      std::erase_if(blockers_,
                    [&](int j) { return j == i || ((j == previous(i) || j == next(i)) && is_convex(j)); });
  }

 private:
  const Vec2& at(int i) const { return corners_[static_cast<std::size_t>(i)]; }
  bool is_convex(int i) const { return geom::orient2(at(previous(i)), at(i), at(next(i))) > 0; }

  std::vector<Vec2> corners_;
  std::vector<int> next_, previous_;
  std::vector<int> blockers_;  ///< corners that are not convex
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(std::span<const Vec3> polygon) {
  if (polygon.size() == 3) return {{0, 1, 2}};
  ShrinkingPolygon rest(project(at_unit_size(polygon)));
  std::vector<std::array<int, 3>> triangles;
  std::size_t left = polygon.size();
  // Going on two corners after each cut spreads the cuts around: a convex polygon is not fanned into slivers.
  std::size_t refused = 0;
  for (int i = 1; left >= 3;) {
    const bool stuck = refused >= left;  // once around without an ear: not simple, cut anyway
    if (!stuck && left > 3 && !rest.is_ear(i)) {
      ++refused;
      i = rest.next(i);
      continue;
    }
    triangles.push_back({rest.previous(i), i, rest.next(i)});
    const int after = rest.next(i);
    rest.cut(i);
    --left;
    refused = 0;
    i = rest.next(after);
  }
  return triangles;
}

}  // namespace io
