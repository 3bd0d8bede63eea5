#include "fpo/spectrum/spacing_tree.h"

#include <numeric>

#include "geom/check.h"

namespace fpo {
namespace {

constexpr std::uint32_t leaf_size = 16;

}  // namespace

SpacingTree::SpacingTree(std::vector<SpectrumPoint> points)
    : points_(std::move(points)), order_(points_.size()) {
  geom::require(!points_.empty() && points_.size() < 100'000'000, "no points, or too many for a spectrum");
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(order_.size()));
  for (const std::uint32_t i : order_) places_.push_back({points_[i].position, points_[i].spacing});
}

void SpacingTree::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t at = nodes_.size();
  Node node{.box = {}, .max_spacing = 0, .first = first, .last = last, .second_child = 0};
  for (std::uint32_t i = first; i < last; ++i) {
    node.box.extend(points_[order_[i]].position);
    node.max_spacing = std::max(node.max_spacing, points_[order_[i]].spacing);
  }
  nodes_.push_back(node);
  if (last - first <= leaf_size) return;
  Eigen::Index axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double xa = points_[a].position[axis], xb = points_[b].position[axis];
                     return xa != xb ? xa < xb : a < b;
                   });
  build(first, middle);
  nodes_[at].second_child = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

void SpacingTree::nearest(const SpectrumPoint& x, std::size_t count, std::vector<Neighbour>& out) const {
  out.clear();
  if (count == 0) return;
  search(0, x, count, out);
  std::sort_heap(out.begin(), out.end());
}

/// Keeps the best so far as a heap, the worst of them on top.
void SpacingTree::search(std::size_t at, const SpectrumPoint& x, std::size_t count,
                         std::vector<Neighbour>& out) const {
  const Node& node = nodes_[at];
  if (out.size() == count && node.box.squaredExteriorDistance(x.position) > out.front().distance2) return;
  if (node.second_child == 0) {
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const SpectrumPoint& p = points_[order_[i]];
      if (p.normal.dot(x.normal) < 0) continue;
      const Neighbour candidate{(p.position - x.position).squaredNorm(), order_[i]};
      if (out.size() == count) {
        if (!(candidate < out.front())) continue;
        std::pop_heap(out.begin(), out.end());
        out.pop_back();
      }
      out.push_back(candidate);
      std::push_heap(out.begin(), out.end());
    }
    return;
  }
  std::size_t first = at + 1, second = node.second_child;
  if (nodes_[second].box.squaredExteriorDistance(x.position) <
      nodes_[first].box.squaredExteriorDistance(x.position))
    std::swap(first, second);
  search(first, x, count, out);
  search(second, x, count, out);
}

}  // namespace fpo
