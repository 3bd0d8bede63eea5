#pragma once
// Spatial search for neighbours without a triangulation: a k-d tree over the sites whose nodes know how far
// the power cells below them reach.
//
// Certificate of rivals(p): if p takes a location x from the cell of j then Pi(x, p) < Pi(x, j) <= reach_j,
// hence |x - p| < sqrt(reach_j + w_p), |x - p_j| <= sqrt(reach_j + w_j), and |p - p_j| is less than the sum.
// Of heirs(): if j owns a location x of the vacancy then |x - p_j|^2 - w_j <= max_radius2, so |center - p_j|
// <= radius + sqrt(max_radius2 + w_j). Both are tested with a margin for rounding; a too large answer costs
// time only.
//
// What a search reads is kept in single precision, so that a leaf is a few lines of the cache: positions off
// by less than `slack`, weights and reaches rounded up.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/short_lists.h"
#include "geom/sites/neighbour_oracle.h"

namespace geom {

/// Leaves split when full, along the longest side of their sites' box, at the median; nothing is ever merged.
/// Adapts to any grading, as long as few sites are nearer to each other than 2^-23 of the largest coordinate.
/// insert, remove, set_reach, queries: O(log n) expected. A site is in one leaf, which it leaves only on
/// remove.
class SiteTree final : public NeighbourOracle {
 public:
  SiteTree() : nodes_(1) {}
  /// Keeps a reference to the points of all sites, who are where it is told that they are.
  explicit SiteTree(const Table<SiteId, WeightedPoint3>& points) : nodes_(1), all_points_(&points) {}

  void insert(SiteId id, const WeightedPoint3& point, SiteId hint = SiteId()) override;
  void remove(SiteId id) override;
  /// It was elsewhere. Its reach is what was said last.
  void move(SiteId id, const WeightedPoint3& point);
  void reserve(std::size_t num_sites) { places_.reserve(num_sites); }
  bool contains(SiteId id) const { return id.index() < places_.size() && places_[id].node.valid(); }
  void rivals(SiteId p, std::vector<SiteId>& out) const override;
  /// Of a site that is not in, or was elsewhere.
  void rivals(const WeightedPoint3& own, std::vector<SiteId>& out) const;
  /// Those of them whose reach is more.
  void rivals_beyond(double least, const WeightedPoint3& own, std::vector<SiteId>& out) const;
  void heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const override;
  void set_reach(SiteId j, double max_radius2) override;
  Nearest nearest(const Location3& x, SiteId without, SiteId hint = SiteId()) const override;

  /// Verifies places, bounds of nodes and separation by the splitting planes. O(n log n). Throws Bug.
  void check() const;

 private:
  using NodeId = Id<struct NodeTag>;
  static constexpr float nothing = -std::numeric_limits<float>::infinity();

  struct Entry {
    std::array<float, 3> position{};  ///< rounded
    float weight = nothing;           ///< rounded up
    float reach = nothing;            ///< max_radius2 of its cell, rounded up
    SiteId site;
  };
  /// A leaf has a list of entries; an inner node splits space at position[axis] = plane, lower part first.
  struct Node {
    float max_reach = nothing, max_weight = nothing;
    float plane = 0;
    std::int32_t axis = -1;  ///< -1: leaf
    NodeId child;            ///< the lower child, the upper is next to it
    NodeId parent;
    bool leaf() const { return axis < 0; }
  };
  struct Place {
    NodeId node;
    std::uint32_t slot = 0;
  };
  /// A node to visit and how far the query point is from its region along each axis.
  struct Visit {
    NodeId node;
    std::array<double, 3> gap;
    double distance2() const { return gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]; }
  };

  static Entry entry_of(SiteId id, const WeightedPoint3& point);
  void know(SiteId id, const WeightedPoint3& point);
  const WeightedPoint3& point_of(SiteId id) const { return all_points_ ? (*all_points_)[id] : points_[id]; }
  NodeId leaf_of(const Entry& entry, int& depth) const;
  void insert(const Entry& entry);
  void add(NodeId node, const Entry& entry);
  void split(NodeId node);
  void raise(NodeId node, const Entry& entry);
  void refresh(NodeId node);
  double distance2(const Vec3& x, const Entry& e) const;
  double limit2(double reach) const;
  /// Calls on_entry(entry, squared distance of its rounded position) for the entries that are no farther from
  /// x than limit2(node) of their leaf's node; leaves whose region is farther than that are not looked at.
  /// The limit of a node must not be less than that of those below.
  template <class Limit2, class OnEntry>
  void visit(const Vec3& x, Limit2 limit2, OnEntry on_entry) const;

  Table<NodeId, Node> nodes_;
  ShortLists<NodeId, Entry> leaves_;
  Table<SiteId, Place> places_;
  const Table<SiteId, WeightedPoint3>* all_points_ = nullptr;
  Table<SiteId, WeightedPoint3> points_;  ///< if nobody else has them
  double slack_ = 0;                      ///< more than the distance of any site from its rounded position
};

}  // namespace geom
