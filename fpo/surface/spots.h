#pragma once
// Places that want shorter edges than the sizing: where the surface is so thin that its type would be lost.

#include <vector>

#include "geom/vec.h"

namespace fpo {

/// At this location edges must not be longer than h.
struct Spot {
  geom::Vec3 at;
  double h;
};

/// The bound of edge lengths that spots set: it grows by `gradation` per length away from each, as the crow
/// flies.
class Spots {
 public:
  explicit Spots(double gradation) : gradation_(gradation) {}

  /// Adds those that say something: lower the bound by more than a tenth where they are.
  void add(const std::vector<Spot>& spots);
  /// The smaller of `most` and the bound at x. O(spots), less where `most` is small.
  double bound(const geom::Vec3& x, double most) const;

  bool empty() const { return spots_.empty(); }
  std::size_t size() const { return spots_.size(); }

 private:
  double gradation_;
  std::vector<Spot> spots_;  ///< ascending by h
};

}  // namespace fpo
