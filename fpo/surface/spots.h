#pragma once
// Places that want shorter edges than the sizing: where the surface is so thin that its type would be lost.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "geom/vec.h"

namespace fpo {

/// At this location edges must not be longer than h.
struct Spot {
  geom::Vec3 at;
  double h;
  double gradation;  ///< by which the bound grows per length away from there, as the crow flies
  double flat = 0;   ///< so far away it is h still

  double bound(const geom::Vec3& x) const { return h + gradation * std::max((x - at).norm() - flat, 0.0); }
};

/// The bound of edge lengths that spots set.
class Spots {
 public:
  /// Adds those that say something, in that order: lower the bound by more than a tenth where they are.
  /// O(spots log spots), and the square of those that are added.
  void add(std::span<const Spot> spots);
  void add(const Spots& others) { add(others.spots_); }
  /// The smaller of `most` and the bound at x. O(log spots) where few of them are near and small.
  double bound(const geom::Vec3& x, double most) const;

  bool empty() const { return spots_.empty(); }
  std::size_t size() const { return spots_.size(); }

 private:
  /// A run of spots: all are in the box, and none wants less anywhere than one of these numbers at its place.
  struct Node {
    geom::Vec3 low, high;
    double least_h, least_gradation, largest_flat;
    std::size_t begin, end;
    std::size_t after;  ///< the node after those below this one
  };
  void build_tree(std::size_t begin, std::size_t end);

  std::vector<Spot> spots_;
  std::vector<Node> tree_;  ///< each node before those below it
};

}  // namespace fpo
