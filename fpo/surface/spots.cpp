#include "fpo/surface/spots.h"

#include <algorithm>
#include <limits>

namespace fpo {

using geom::Vec3;

namespace {

constexpr double says_something = 0.9;
constexpr std::size_t leaf_size = 8;
constexpr double rounding = 1 + 1e-9;  // what cannot be less is not looked at

double least_bound(std::span<const Spot> spots, const Vec3& x, double most) {
  for (const Spot& spot : spots) most = std::min(most, spot.bound(x));
  return most;
}

}  // namespace

void Spots::add(std::span<const Spot> spots) {
  std::vector<Spot> added;
  for (const Spot& spot : spots) {
    const double most = bound(spot.at, std::numeric_limits<double>::infinity());
    if (spot.h < says_something * least_bound(added, spot.at, most)) added.push_back(spot);
  }
  if (added.empty()) return;
  spots_.insert(spots_.end(), added.begin(), added.end());
  tree_.clear();
  build_tree(0, spots_.size());
}

double Spots::bound(const Vec3& x, double most) const {
  for (std::size_t i = 0; i < tree_.size();) {
    const Node& node = tree_[i];
    const Vec3 nearest = x.cwiseMax(node.low).cwiseMin(node.high);
    const Spot least{nearest, node.least_h, node.least_gradation, node.largest_flat};
    if (!(least.bound(x) < most * rounding)) {
      i = node.after;
      continue;
    }
    if (node.after == i + 1)
      most = least_bound(std::span(spots_).subspan(node.begin, node.end - node.begin), x, most);
    ++i;
  }
  return most;
}

/// Halves along the longest side.
void Spots::build_tree(std::size_t begin, std::size_t end) {
  const std::size_t at = tree_.size();
  const Spot& first = spots_[begin];
  Node node{first.at, first.at, first.h, first.gradation, first.flat, begin, end, 0};
  for (std::size_t i = begin; i < end; ++i) {
    node.low = node.low.cwiseMin(spots_[i].at);
    node.high = node.high.cwiseMax(spots_[i].at);
    node.least_h = std::min(node.least_h, spots_[i].h);
    node.least_gradation = std::min(node.least_gradation, spots_[i].gradation);
    node.largest_flat = std::max(node.largest_flat, spots_[i].flat);
  }
  tree_.push_back(node);
  if (end - begin > leaf_size) {
    int axis = 0;
    (node.high - node.low).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto place = [&](std::size_t i) { return spots_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(place(begin), place(middle), place(end),
                     [&](const Spot& a, const Spot& b) { return a.at[axis] < b.at[axis]; });
    build_tree(begin, middle);
    build_tree(middle, end);
  }
  tree_[at].after = tree_.size();
}

}  // namespace fpo
