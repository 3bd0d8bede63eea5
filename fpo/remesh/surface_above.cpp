#include "fpo/remesh/surface_above.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetId;
using geom::Vec3;

namespace {

constexpr double prism_margin = 0.6;  // in heights: prisms of neighbours leave wedges between them
constexpr double rounding = 1e-9;
constexpr int halvings = 3;
constexpr int parts = 4;  // of an edge within

class Prism {
 public:
  /// None over a triangle without area. `up`: to the side where its surface's normals point.
  static std::optional<Prism> over(const std::array<Vec3, 3>& corners, const Vec3& up) {
    Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double area2 = normal.norm();
    if (!(area2 > 0) || up.isZero()) return {};
    normal /= area2;
    if (normal.dot(up) < 0) normal = -normal;
    return Prism(corners, normal, area2);
  }

  const Vec3& up() const { return up_; }

  /// The share [from, to] of a segment that lies within.
  std::optional<std::pair<double, double>> share(const Vec3& a, const Vec3& b) const {
    double from = 0, to = 1;
    for (const Side& side : sides_) {
      const double at_a = side.inside(a), at_b = side.inside(b);
      if (at_a < 0 && at_b < 0) return {};
      if (at_a < 0) from = std::max(from, at_a / (at_a - at_b));
      if (at_b < 0) to = std::min(to, at_a / (at_a - at_b));
    }
    if (from > to) return {};
    return std::pair(from, to);
  }

 private:
  struct Side {
    Vec3 inward;
    double offset;
    double inside(const Vec3& x) const { return inward.dot(x) + offset; }
  };

  Prism(const std::array<Vec3, 3>& corners, const Vec3& up, double area2) : up_(up) {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
      Vec3 inward = up.cross(b - a) / area2;  // 1 more at corner i than along the edge
      if (inward.dot(corners[i] - a) < 0) inward = -inward;
      sides_[i] = {inward, prism_margin - inward.dot(a)};
      longest = std::max(longest, (b - a).norm());
    }
    sides_[3] = {up, longest - up.dot(corners[0])};
    sides_[4] = {-up, longest + up.dot(corners[0])};
  }

  Vec3 up_;
  std::array<Side, 5> sides_;
};

}  // namespace

FarPoint SurfaceAbove::farthest(const std::array<SurfaceSample, 3>& corners, double enough,
                                const std::function<void(std::vector<Triangle>&)>& beside) {
  Triangle triangle;
  Vec3 up(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    triangle[i] = corners[i].position;
    up += mesh_.normal(corners[i].facet).normalized();
  }
  FarPoint far{0, corners[0]};
  const std::optional<Prism> prism = Prism::over(triangle, up);
  if (!prism) return far;
  facets_.clear();
  beside_.clear();
  const auto reach = [&](FacetId t) {
    if (t.valid() && mesh_.normal(t).dot(prism->up()) > 0 && std::ranges::find(facets_, t) == facets_.end())
      facets_.push_back(t);
  };
  const auto nearer_to_others = [&](const Vec3& x, double distance2) {
    if (beside_.empty()) beside(beside_);
    return std::ranges::any_of(beside_, [&](const Triangle& other) {
      return geom::closest_point(x, other).distance2 < (1 - rounding) * distance2;
    });
  };
  for (const SurfaceSample& x : corners) reach(x.facet);
  double most2 = enough * enough;
  for (std::size_t k = 0; k < facets_.size(); ++k)
    for (int e = 0; e < 3; ++e) {
      const FacetId t = facets_[k], other = mesh_.across(t, e);
      const auto seen = std::ranges::find(facets_, other);
      if (other.valid() && seen < facets_.begin() + static_cast<std::ptrdiff_t>(k)) continue;
      const Vec3 &a = mesh_.corner(t, e), &b = mesh_.corner(t, (e + 1) % 3);
      const auto share = prism->share(a, b);
      if (!share) continue;
      reach(other);
      const auto attempt = [&](double way) {
        const double s = share->first + (share->second - share->first) * way;
        const Vec3 x = s == 0 ? a : s == 1 ? b : Vec3(a + s * (b - a));
        const double distance2 = geom::closest_point(x, triangle).distance2;
        if (distance2 <= most2 || nearer_to_others(x, distance2)) return false;
        most2 = distance2;
        far = {std::sqrt(distance2), {geom::snapped(x), t}};
        return true;
      };
      double best = -1, step = 1.0 / parts;
      for (int i = 0; i <= parts; ++i)
        if (attempt(i * step)) best = i * step;
      for (int halving = 0; best >= 0 && halving < halvings; ++halving) {
        step /= 2;
        if (best > 0 && attempt(best - step))
          best -= step;
        else if (best < 1 && attempt(best + step))
          best += step;
      }
    }
  return far;
}

}  // namespace fpo
