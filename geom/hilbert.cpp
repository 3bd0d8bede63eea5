#include "geom/hilbert.h"

#include <algorithm>
#include <utility>

namespace geom {
namespace {

constexpr int levels = 20;

std::uint32_t grid_cell(double x, double extent) {
  const double cell = std::clamp(x / extent, 0.0, 1.0) * (1u << levels);
  return std::min(static_cast<std::uint32_t>(cell), (1u << levels) - 1);
}

}  // namespace

// Down the quadtree: each level appends the quadrant's place along the curve and turns the quadrant so that
// the curve inside it starts and ends like the curve of the whole.
std::uint64_t hilbert_index(std::uint32_t column, std::uint32_t row) {
  std::uint64_t index = 0;
  for (std::uint32_t bit = 1u << (levels - 1); bit > 0; bit >>= 1) {
    const bool right = column & bit, upper = row & bit;
    index = 4 * index + (right ? (upper ? 2 : 3) : (upper ? 1 : 0));
    if (upper) continue;
    if (right) {
      column = ~column;
      row = ~row;
    }
    std::swap(column, row);
  }
  return index;
}

std::vector<std::uint32_t> hilbert_order(const std::vector<Vec2>& points, const Vec2& extent) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  keyed.reserve(points.size());
  for (const Vec2& p : points) {
    const std::uint64_t key = hilbert_index(grid_cell(p.x(), extent.x()), grid_cell(p.y(), extent.y()));
    keyed.emplace_back(key, static_cast<std::uint32_t>(keyed.size()));
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const auto& [key, i] : keyed) order.push_back(i);
  return order;
}

}  // namespace geom
