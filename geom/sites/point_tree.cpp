#include "geom/sites/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geom {
namespace {

constexpr float beyond = std::numeric_limits<float>::infinity();
constexpr std::size_t most_waiting = 72;  // one sibling a level, and fewer than 64 levels

}  // namespace

PointTree::PointTree(std::span<const Vec3> points) : points_(points.begin(), points.end()) {
  for (const Vec3& p : points_) largest_ = std::max(largest_, p.lpNorm<Eigen::Infinity>());
  std::size_t num_leaves = 1;
  while (num_leaves * in_leaf < points_.size()) num_leaves *= 2;
  first_leaf_ = num_leaves - 1;
  boxes_.resize(2 * num_leaves - 1);
  leaves_.resize(num_leaves);
  order_.reserve(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) order_.emplace_back(i);
  make(0, 0, points_.size());
  order_ = {};
}

/// Of the points order_[first], ... order_[last - 1]: halved at the median of the longest side.
PointTree::Box PointTree::make(std::size_t node, std::size_t first, std::size_t last) {
  Box& box = boxes_[node] = {{beyond, beyond, beyond, 0}, {-beyond, -beyond, -beyond, 0}};
  const auto coordinate = [&](std::size_t k, std::size_t axis) {
    return points_[order_[k].index()][static_cast<Eigen::Index>(axis)];
  };
  for (std::size_t k = first; k < last; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto c = static_cast<float>(coordinate(k, i));
      box.low[i] = std::min(box.low[i], c);
      box.high[i] = std::max(box.high[i], c);
    }
  if (is_leaf(node)) {
    Leaf& leaf = leaves_[node - first_leaf_];
    leaf.x.fill(beyond), leaf.y.fill(beyond), leaf.z.fill(beyond);
    for (std::size_t k = first; k < last; ++k) {
      leaf.x[k - first] = static_cast<float>(coordinate(k, 0));
      leaf.y[k - first] = static_cast<float>(coordinate(k, 1));
      leaf.z[k - first] = static_cast<float>(coordinate(k, 2));
      leaf.sites[k - first] = order_[k];
    }
    return box;
  }
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (box.high[i] - box.low[i] > box.high[axis] - box.low[axis]) axis = i;
  const std::size_t half = first + (last - first) / 2;
  const auto at = [&](std::size_t k) { return order_.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto key = [&](SiteId s) {
    return std::pair(points_[s.index()][static_cast<Eigen::Index>(axis)], s);
  };
  std::nth_element(at(first), at(half), at(last), [&](SiteId a, SiteId b) { return key(a) < key(b); });
  make(2 * node + 1, first, half);
  make(2 * node + 2, half, last);
  return box;
}

/// Rounding moves a coordinate by a 2^-24th of it at most, and what is too small for that by 2^-150.
PointTree::Place PointTree::rounded(const Vec3& x) const {
  const double size = std::max(largest_, x.lpNorm<Eigen::Infinity>());
  return {{static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z()), 0},
          0x1p-20 * size + 1e-40};
}

/// What is that far has at most this computed squared distance.
float PointTree::limit2(double distance, double slack) {
  const double far = distance + slack;
  return static_cast<float>(far * far * (1 + 1e-5) + 1e-40);
}

float PointTree::distance2(const Box& box, const Place& x) {
  std::array<float, 4> gap;
  for (std::size_t i = 0; i < 4; ++i)
    gap[i] = std::max(std::max(box.low[i] - x.at[i], x.at[i] - box.high[i]), 0.0f);
  return (gap[0] * gap[0] + gap[1] * gap[1]) + gap[2] * gap[2];
}

void PointTree::distances2(const Leaf& leaf, const Place& x, std::array<float, in_leaf>& out) {
  for (std::size_t e = 0; e < in_leaf; ++e) {
    const float dx = leaf.x[e] - x.at[0], dy = leaf.y[e] - x.at[1], dz = leaf.z[e] - x.at[2];
    out[e] = (dx * dx + dy * dy) + dz * dz;
  }
}

void PointTree::heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const {
  const Place x = rounded(vacancy.center);
  const double distance = vacancy.radius + std::sqrt(std::max(vacancy.max_radius2, 0.0));
  const float limit = limit2(distance, x.slack);
  std::array<std::size_t, most_waiting> stack;
  std::size_t height = 0;
  stack[height++] = 0;
  std::array<float, in_leaf> far2;
  while (height > 0) {
    const std::size_t node = stack[--height];
    if (!(distance2(boxes_[node], x) <= limit)) continue;
    if (!is_leaf(node)) {
      stack[height++] = 2 * node + 2;
      stack[height++] = 2 * node + 1;
      continue;
    }
    const Leaf& leaf = leaves_[node - first_leaf_];
    distances2(leaf, x, far2);
    for (std::size_t e = 0; e < in_leaf; ++e)
      if (far2[e] <= limit && leaf.sites[e].valid()) out.push_back(leaf.sites[e]);
  }
}

NearSites::Nearest PointTree::nearest(const Location3& x, SiteId without, SiteId) const {
  const Place place = rounded(x.position);
  Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
  float limit = beyond;
  const auto look_into = [&](const Leaf& leaf) {
    std::array<float, in_leaf> far2;
    distances2(leaf, place, far2);
    for (std::size_t e = 0; e < in_leaf; ++e) {
      const SiteId s = leaf.sites[e];
      if (!(far2[e] <= limit) || s == without || !s.valid()) continue;
      const double radius2 = power(x, WeightedPoint3{points_[s.index()], 0});
      if (!(radius2 < best.radius2 || (radius2 == best.radius2 && s < best.site))) continue;
      best = {s, radius2};
      limit = limit2(std::sqrt(radius2), place.slack);
    }
  };
  struct Waiting {
    std::size_t node;
    float distance2;
  };
  std::array<Waiting, most_waiting> stack;
  std::size_t height = 0;
  stack[height++] = {0, 0};
  while (height > 0) {
    auto [node, near2] = stack[--height];
    if (!(near2 <= limit)) continue;
    while (!is_leaf(node)) {
      Waiting near{2 * node + 1, distance2(boxes_[2 * node + 1], place)},
          far{2 * node + 2, distance2(boxes_[2 * node + 2], place)};
      if (far.distance2 < near.distance2) std::swap(near, far);
      if (far.distance2 <= limit) stack[height++] = far;
      node = near.node;
    }
    look_into(leaves_[node - first_leaf_]);
  }
  return best;
}

}  // namespace geom
