#include "geom/hilbert.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace geom {
namespace {

constexpr int levels = 20;

std::uint32_t grid_cell(double x, double extent) {
  const double cell = extent > 0 ? std::clamp(x / extent, 0.0, 1.0) * (1u << levels) : 0;
  return std::min(static_cast<std::uint32_t>(cell), (1u << levels) - 1);
}

template <class Point, class Key>
std::vector<std::uint32_t> order_by_key(const std::vector<Point>& points, const Key& key) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  keyed.reserve(points.size());
  for (const Point& p : points) keyed.emplace_back(key(p), static_cast<std::uint32_t>(keyed.size()));
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const auto& [k, i] : keyed) order.push_back(i);
  return order;
}

/// An octant's place along the curve through its cube, and the way of the curve through the octant: entry and
/// axis as 3 entry + axis.
struct OctantStep {
  std::uint8_t place, way;
};
using OctantSteps = std::array<std::array<OctantStep, 8>, 24>;

// The curve through a cube goes in at corner `entry` and leaves at its neighbour along `axis`; turned such
// that it goes from 0 along axis 2, it visits the octants in the order of the Gray code. Octant w is entered
// at the corner gray(w - 1) for odd w, gray(w - 2) for even ones, and crossed along the axis on which w's
// lowest run of ones (of w - 1 if w is even) ends.
constexpr OctantSteps octant_steps() {
  const auto turned = [](std::uint32_t bits, std::uint32_t by) {
    return (bits << by | bits >> (3 - by)) & 7;
  };
  OctantSteps steps{};
  for (std::uint32_t entry = 0; entry < 8; ++entry)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const std::uint32_t gray = turned(octant ^ entry, (2 - axis) % 3);
        const std::uint32_t w = gray ^ gray >> 1 ^ gray >> 2;
        const std::uint32_t before = w == 0 ? 0 : (w - 1) & ~1u;
        const std::uint32_t next = entry ^ turned(before ^ before >> 1, (axis + 1) % 3);
        const int ones = w == 0 ? 0 : std::countr_one(w % 2 == 0 ? w - 1 : w);
        const std::uint32_t next_axis = (axis + static_cast<std::uint32_t>(ones) + 1) % 3;
        steps[3 * entry + axis][octant] = {static_cast<std::uint8_t>(w),
                                           static_cast<std::uint8_t>(3 * next + next_axis)};
      }
  return steps;
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
  return order_by_key(points, [&](const Vec2& p) {
    return hilbert_index(grid_cell(p.x(), extent.x()), grid_cell(p.y(), extent.y()));
  });
}

// Down the octree, in steps that are known in advance.
std::uint64_t hilbert_index(const std::array<std::uint32_t, 3>& cell) {
  static constexpr OctantSteps steps = octant_steps();
  std::uint64_t index = 0;
  std::size_t way = 0;
  for (int level = levels - 1; level >= 0; --level) {
    const std::uint32_t octant =
        (cell[0] >> level & 1) | (cell[1] >> level & 1) << 1 | (cell[2] >> level & 1) << 2;
    const OctantStep& step = steps[way][octant];
    index = 8 * index + step.place;
    way = step.way;
  }
  return index;
}

std::vector<std::uint32_t> hilbert_order(const std::vector<Vec3>& points, const Box3& box) {
  const double extent = box.sizes().maxCoeff();
  return order_by_key(points, [&](const Vec3& p) {
    const Vec3 x = p - box.min();
    return hilbert_index({grid_cell(x.x(), extent), grid_cell(x.y(), extent), grid_cell(x.z(), extent)});
  });
}

}  // namespace geom
