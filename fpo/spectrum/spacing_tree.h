#pragma once
// A static k-d tree over points that have a spacing: who is near in units of it.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fpo/spectrum/spectrum_point.h"

namespace fpo {

/// Built in O(n log n); a query takes O(log n) and the number of points that it finds.
class SpacingTree {
 public:
  explicit SpacingTree(std::vector<SpectrumPoint> points);

  const std::vector<SpectrumPoint>& points() const { return points_; }  ///< in the order given

  /// The indices of the points, those near each other together.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls f(k) for each point p = points()[order()[k]] with |p - x| < radius (r_x + r_p) / 2, in an order
  /// that depends on the points alone.
  template <class F>
  void each_near(const SpectrumPoint& x, double radius, F&& f) const;

  /// The `count` points nearest to x in space, the nearest first (equally near: the smaller index first),
  /// among those whose normals are within 90 degrees of that of x; fewer if there are fewer.
  struct Neighbour {
    double distance2;
    std::uint32_t index;
    auto operator<=>(const Neighbour&) const = default;
  };
  void nearest(const SpectrumPoint& x, std::size_t count, std::vector<Neighbour>& out) const;

 private:
  /// Nodes in preorder: the first child of an inner node follows it.
  struct Node {
    geom::Box3 box;
    double max_spacing = 0;
    std::uint32_t first = 0, last = 0;  ///< into order_
    std::uint32_t second_child = 0;     ///< 0: leaf
  };
  /// What each_near() looks at, in the order of the leaves.
  struct Place {
    geom::Vec3 position;
    double spacing;
  };
  void build(std::uint32_t first, std::uint32_t last);
  void search(std::size_t at, const SpectrumPoint& x, std::size_t count, std::vector<Neighbour>& out) const;

  std::vector<SpectrumPoint> points_;
  std::vector<std::uint32_t> order_;
  std::vector<Place> places_;
  std::vector<Node> nodes_;
};

template <class F>
void SpacingTree::each_near(const SpectrumPoint& x, double radius, F&& f) const {
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const Node& node = nodes_[at];
    const double reach = radius * (x.spacing + node.max_spacing) / 2;
    if (node.box.squaredExteriorDistance(x.position) > reach * reach * (1 + 1e-12)) continue;
    if (node.second_child == 0) {
      for (std::uint32_t i = node.first; i < node.last; ++i) {
        const Place& p = places_[i];
        const double limit = radius * (x.spacing + p.spacing) / 2;
        if ((p.position - x.position).squaredNorm() < limit * limit) f(i);
      }
    } else {
      open.push_back(node.second_child);
      open.push_back(at + 1);
    }
  }
}

}  // namespace fpo
