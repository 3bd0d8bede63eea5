#include "geom/repair/fill_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace geom {
namespace {

using Triangle = std::array<std::size_t, 3>;

constexpr std::size_t most_at_once = 200;
constexpr double bend_step = 1.0 / 16;  // of 1 - cos
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of a set of triangles; the less, the better.
struct Cost {
  double bend = 0;  ///< the largest, in steps
  double area = 0;

  bool operator<(const Cost& other) const {
    return bend != other.bend ? bend < other.bend : area < other.area;
  }
};

Cost operator+(const Cost& a, const Cost& b) { return {std::max(a.bend, b.bend), a.area + b.area}; }

Vec3 unit(const Vec3& normal) {
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(0, 0, 0);
}

/// How much two triangles bend at their common edge. Facets without a normal say nothing, triangles of the
/// filling without area are the worst.
double bend(const Vec3& m, const Vec3& n) { return std::round((1 - m.dot(n)) / bend_step); }

/// The polygon of some corners, in order.
class Filling {
 public:
  Filling(const PolygonRim& rim, std::vector<std::size_t> corners, std::vector<Vec3> across)
      : rim_(rim), corners_(std::move(corners)), across_(std::move(across)), n_(corners_.size()) {}

  std::vector<Triangle> run() {
    spans_.assign(n_ * n_, {});
    for (std::size_t i = 0; i + 1 < n_; ++i) span(i, i + 1) = {{0, 0}, 0, across_[i]};
    for (std::size_t width = 2; width < n_; ++width)
      for (std::size_t i = 0; i + width < n_; ++i) choose(i, i + width);
    std::vector<Triangle> triangles;
    if (span(0, n_ - 1).cost.area < infinite) collect(0, n_ - 1, triangles);
    return triangles;
  }

 private:
  /// The best triangles between corners i and j, i < j.
  struct Span {
    Cost cost{infinite, infinite};
    std::size_t apex = 0;  ///< of the triangle at the edge from i to j
    Vec3 normal{0, 0, 0};
  };
  Span& span(std::size_t i, std::size_t j) { return spans_[i * n_ + j]; }
  const Vec3& point(std::size_t i) const { return rim_.corners[corners_[i]]; }

  void choose(std::size_t i, std::size_t k) {
    const bool last = i == 0 && k + 1 == n_;
    if (!last && rim_.forbidden(corners_[i], corners_[k])) return;
    Span& best = span(i, k);
    for (std::size_t j = i + 1; j < k; ++j) {
      const Span &left = span(i, j), &right = span(j, k);
      if (left.cost.area == infinite || right.cost.area == infinite) continue;
      const Vec3 normal = (point(j) - point(i)).cross(point(k) - point(i)), n = unit(normal);
      Cost cost = left.cost + right.cost;
      const double worst = n.isZero(0) ? 4 / bend_step : 0;
      cost.bend = std::max({cost.bend, worst, bend(n, left.normal), bend(n, right.normal)});
      if (last) cost.bend = std::max(cost.bend, bend(n, across_[k]));
      cost.area += normal.norm();
      if (cost < best.cost) best = {cost, j, n};
    }
  }

  void collect(std::size_t i, std::size_t k, std::vector<Triangle>& triangles) {
    if (k == i + 1) return;
    const std::size_t j = span(i, k).apex;
    triangles.push_back({corners_[i], corners_[j], corners_[k]});
    collect(i, j, triangles);
    collect(j, k, triangles);
  }

  const PolygonRim& rim_;
  std::vector<std::size_t> corners_;
  std::vector<Vec3> across_;
  std::size_t n_;
  std::vector<Span> spans_;
};

/// Cuts ears off a long polygon: those that are shortest across and do not bend much.
class Ears {
 public:
  explicit Ears(const PolygonRim& rim) : rim_(rim), across_(rim.across.begin(), rim.across.end()) {
    corners_.resize(rim.corners.size());
    std::iota(corners_.begin(), corners_.end(), std::size_t{0});
  }

  /// Whether few enough corners are left.
  bool cut(std::vector<Triangle>& triangles) {
    if (corners_.size() <= most_at_once) return true;
    for (std::size_t i = 0; i < corners_.size(); ++i) costs_.push_back(cost_of(i));
    while (corners_.size() > most_at_once) {
      const auto least = std::ranges::min_element(costs_);
      if (!(*least < infinite)) return false;
      const auto best = static_cast<std::size_t>(least - costs_.begin());
      const Triangle ear = {corners_[before(best)], corners_[best], corners_[after(best)]};
      triangles.push_back(ear);
      across_[before(best)] = normal_of(ear);
      across_.erase(across_.begin() + static_cast<std::ptrdiff_t>(best));
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(best));
      costs_.erase(least);
      const std::size_t next = best < corners_.size() ? best : 0;
      for (const std::size_t i : {before(next), next}) costs_[i] = cost_of(i);
    }
    return true;
  }
  const std::vector<std::size_t>& corners() const { return corners_; }
  const std::vector<Vec3>& across() const { return across_; }

 private:
  std::size_t before(std::size_t i) const { return i == 0 ? corners_.size() - 1 : i - 1; }
  std::size_t after(std::size_t i) const { return i + 1 == corners_.size() ? 0 : i + 1; }
  Vec3 normal_of(const Triangle& t) const {
    return unit((rim_.corners[t[1]] - rim_.corners[t[0]]).cross(rim_.corners[t[2]] - rim_.corners[t[0]]));
  }

  double cost_of(std::size_t i) const {
    const Triangle ear = {corners_[before(i)], corners_[i], corners_[after(i)]};
    if (rim_.forbidden(ear[0], ear[2])) return infinite;
    const Vec3 n = normal_of(ear);
    const double worst =
        n.isZero(0) ? 4 / bend_step : std::max(bend(n, across_[before(i)]), bend(n, across_[i]));
    return (1 + worst) * (rim_.corners[ear[2]] - rim_.corners[ear[0]]).norm();
  }

  const PolygonRim& rim_;
  std::vector<std::size_t> corners_;
  std::vector<Vec3> across_;
  std::vector<double> costs_;  ///< of the ear at each corner
};

}  // namespace

std::vector<std::array<std::size_t, 3>> filled(const PolygonRim& rim) {
  std::vector<Triangle> triangles;
  Ears ears(rim);
  if (!ears.cut(triangles)) return {};
  const std::vector<Triangle> rest = Filling(rim, ears.corners(), ears.across()).run();
  if (rest.empty()) return {};
  triangles.insert(triangles.end(), rest.begin(), rest.end());
  return triangles;
}

}  // namespace geom
