#pragma once
// Weighted points that are as hard on predicates as we know: degenerate ones, those one ulp off, at both ends
// of the valid range (geom/exact/predicates.h).

#include <span>
#include <string>
#include <vector>

#include "geom/rng.h"
#include "geom/vec.h"

namespace storm {

/// The valid range: coordinates are multiples of 2^unit, of magnitude at most 2^top; weights likewise with
/// twice the exponents.
struct Range {
  int unit, top;
};

/// A kind of draw: one base (all of fixtures::Hardship and more), then one change to all of it.
class Kind {
 public:
  enum class Change {
    none,
    ulps,  ///< a quarter of the numbers moved by one unit in the last place
    low,   ///< scaled so that the finest number is one unit: products are denormal
    high   ///< scaled so that the largest number is at the top
  };

  static const std::vector<Kind>& all();

  std::string name() const;
  /// Fills all of `points` within the range; the last `corners` of them are corners of a facet (their weights
  /// mean nothing), the others sites. `flat`: z = 0.
  struct Order {
    std::size_t corners = 0;
    bool flat = false;
    Range range{-160, 160};
  };
  void draw(std::span<geom::WeightedPoint3> points, const Order& order, geom::Rng& rng) const;

 private:
  Kind(int base, Change change) : base_(base), change_(change) {}
  int base_;
  Change change_;
};

}  // namespace storm
