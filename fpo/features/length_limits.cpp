#include "fpo/features/length_limits.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fpo {

using geom::Box3;
using geom::Vec3;

namespace {

constexpr std::size_t leaf_size = 8;
constexpr double less = 1 - 1e-12;  // a dozen roundings are 2e-15

}  // namespace

struct LengthLimits::Query {
  Vec3 x;
  GridCell cell;
  Box3 around;  ///< its cell and those beside it, and a bit more
  Limit limit;
};

LengthLimits::LengthLimits(const std::vector<NarrowPlace>& places, double slope, double most)
    : places_(places), slope_(slope), cell_(most / slope), order_(places.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  for (const NarrowPlace& place : places) cells_.push_back(grid_cell(place.at, cell_));
  if (!places.empty()) build(0, places.size());
}

/// Halves across the longest side of the box.
void LengthLimits::build(std::size_t begin, std::size_t end) {
  const std::size_t node = nodes_.size();
  Node& made = nodes_.emplace_back();
  made.begin = begin, made.end = end;
  for (std::size_t i = begin; i < end; ++i) {
    made.box.extend(places_[order_[i]].at);
    made.least_width = std::min(made.least_width, places_[order_[i]].width);
  }
  if (end - begin <= leaf_size) return;
  Eigen::Index axis = 0;
  made.box.sizes().maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::size_t a, std::size_t b) {
    const double u = places_[a].at[axis], v = places_[b].at[axis];
    return u != v ? u < v : a < b;
  });
  build(begin, middle);
  nodes_[node].second = nodes_.size();
  build(middle, end);
}

LengthLimits::Limit LengthLimits::at(const Vec3& x) const {
  Query query{x, grid_cell(x, cell_), Box3(), {}};
  for (const int beside : {-1, 2}) {
    Vec3 corner;
    for (std::size_t i = 0; i < 3; ++i)
      corner[static_cast<Eigen::Index>(i)] = static_cast<double>(query.cell[i] + beside) * cell_;
    query.around.extend(corner + Vec3::Constant((beside < 0 ? -1e-6 : 1e-6) * cell_));
  }
  if (!nodes_.empty()) look_at(0, query);
  return query.limit;
}

/// The nearer child first. A place of the node is at least as wide as its narrowest, and its distance as it
/// is computed is at least `least`, which is lowered by more than a norm and a distance from a box are
/// rounded; products and sums round monotonically, so its limit as it is computed is at least the bound.
void LengthLimits::look_at(std::size_t node, Query& query) const {
  const Node& n = nodes_[node];
  if (!query.around.intersects(n.box)) return;
  const double least = n.box.exteriorDistance(query.x) * less;
  if (widths_of_length * n.least_width + slope_ * least >= query.limit.length &&
      least >= query.limit.distance)
    return;
  if (n.second != 0) {
    const std::size_t first = node + 1;
    const bool turned = nodes_[n.second].box.squaredExteriorDistance(query.x) <
                        nodes_[first].box.squaredExteriorDistance(query.x);
    look_at(turned ? n.second : first, query);
    look_at(turned ? first : n.second, query);
    return;
  }
  for (std::size_t i = n.begin; i < n.end; ++i) {
    const GridCell& cell = cells_[order_[i]];
    const auto is_beside = [&](std::size_t k) { return std::abs(cell[k] - query.cell[k]) <= 1; };
    if (!is_beside(0) || !is_beside(1) || !is_beside(2)) continue;
    const NarrowPlace& place = places_[order_[i]];
    const double d = (place.at - query.x).norm();
    query.limit.length = std::min(query.limit.length, widths_of_length * place.width + slope_ * d);
    query.limit.distance = std::min(query.limit.distance, d);
  }
}

}  // namespace fpo
