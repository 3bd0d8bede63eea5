#pragma once
// Spatial search for neighbours without a triangulation: a k-d tree over the sites whose nodes know how far
// the power cells below them reach.
//
// Certificate of rivals(p): if p takes a location x from the cell of j then Pi(x, p) < Pi(x, j) <= reach_j,
// hence |x - p| < sqrt(reach_j + w_p), |x - p_j| <= sqrt(reach_j + w_j), and |p - p_j| is less than the sum.
// Of heirs(): if j owns a location x of the vacancy then |x - p_j|^2 - w_j <= max_radius2, so |center - p_j|
// <= radius + sqrt(max_radius2 + w_j). Both are tested with a margin for rounding; a too large answer costs
// time only.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/neighbour_source.h"

namespace geom {

/// Leaves split when full, along the longest side of their sites' box, at the median; nothing is ever merged.
/// Adapts to any grading. insert, remove, set_reach, queries: O(log n) expected. A site is in one leaf, which
/// it leaves only on remove.
class SiteTree final : public NeighbourSource {
 public:
  SiteTree();

  void insert(SiteId id, const WeightedPoint3& point, SiteId hint = SiteId()) override;
  void remove(SiteId id) override;
  void rivals(SiteId p, std::vector<SiteId>& out) const override;
  void heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const override;
  void set_reach(SiteId j, double max_radius2) override;
  Nearest nearest(const Vec3& x, SiteId without, SiteId hint = SiteId()) const override;

  /// Verifies places, bounds of nodes and separation by the splitting planes. O(n log n). Throws Bug.
  void check() const;

 private:
  struct Entry {
    Vec3 position;
    double weight;
    double reach;  ///< max_radius2 of its cell
    SiteId site;
  };
  /// A leaf holds entries; an inner node splits space at position[axis] = plane, lower part first.
  struct Node {
    double max_reach = -std::numeric_limits<double>::infinity();
    double max_weight = -std::numeric_limits<double>::infinity();
    double plane = 0;
    std::int32_t axis = -1;   ///< -1: leaf
    std::int32_t child = -1;  ///< inner: the lower child, the upper is next to it; leaf: index into leaves_
    std::int32_t parent = -1;
    bool leaf() const { return axis < 0; }
  };
  struct Place {
    std::int32_t node = -1;
    std::int32_t slot = -1;
  };
  /// A node to visit and how far the query point is from its region along each axis.
  struct Visit {
    std::int32_t node;
    std::array<double, 3> gap;
    double distance2() const { return gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]; }
  };

  std::vector<Entry>& leaf(std::int32_t node) {
    return leaves_[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)].child)];
  }
  const std::vector<Entry>& leaf(std::int32_t node) const {
    return leaves_[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)].child)];
  }
  const Entry& entry(SiteId id) const;
  void split(std::int32_t node);
  void refresh(std::int32_t node);
  /// Calls on_leaf for the entries of each leaf whose node passes `wanted(node, squared distance of x to its
  /// region)`.
  template <class Wanted, class OnEntry>
  void visit(const Vec3& x, Wanted wanted, OnEntry on_entry) const;

  std::vector<Node> nodes_;
  std::vector<std::vector<Entry>> leaves_;
  Table<SiteId, Place> places_;
};

}  // namespace geom
