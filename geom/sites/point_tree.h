#pragma once
// Points that stay where they are: a balanced k-d tree, made at once, in the order of its leaves.
//
// What a search reads are boxes and coordinates in single precision, a leaf as three rows that are compared
// at once; what it finds there is decided in doubles. Let s be more than what rounding moves a coordinate of
// the points, the boxes and the place that is asked for: then a computed distance is off by less than 4 s and
// a 2^-20th of itself, for which limits have room. A too large answer costs time only.

#include <array>
#include <span>
#include <vector>

#include "geom/sites/neighbour_oracle.h"

namespace geom {

class PointTree final : public NearSites {
 public:
  /// Point i is site i, without weight and level. O(n log n).
  explicit PointTree(std::span<const Vec3> points);

  /// O(log n) and as many as are found, expected.
  void heirs(const Vacancy& vacancy, std::vector<SiteId>& out) const override;
  Nearest nearest(const Location3& x, SiteId without, SiteId hint = SiteId()) const override;

 private:
  static constexpr std::size_t in_leaf = 8;
  /// The four of a row are one register; the last is 0.
  struct Box {
    std::array<float, 4> low, high;
  };
  struct Leaf {
    std::array<float, in_leaf> x, y, z;  ///< infinity beyond the points
    std::array<SiteId, in_leaf> sites;
  };
  struct Place {
    std::array<float, 4> at;
    double slack;
  };
  Place rounded(const Vec3& x) const;
  static float limit2(double distance, double slack);
  static float distance2(const Box& box, const Place& x);
  static void distances2(const Leaf& leaf, const Place& x, std::array<float, in_leaf>& out);
  Box make(std::size_t node, std::size_t first, std::size_t last);
  bool is_leaf(std::size_t node) const { return node >= first_leaf_; }

  std::vector<Vec3> points_;
  std::vector<SiteId> order_;  ///< only while the tree is made
  std::vector<Box> boxes_;     ///< of node i, whose children are 2 i + 1 and 2 i + 2
  std::vector<Leaf> leaves_;   ///< of the nodes from first_leaf_ on
  std::size_t first_leaf_ = 0;
  double largest_ = 0;  ///< coordinate
};

}  // namespace geom
