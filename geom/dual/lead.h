#pragma once
// By how much one site is nearer to a location than another one, with a bound on the error.

#include <cmath>

#include "geom/vec.h"

namespace geom {

/// A value whose sign is certain if its magnitude is more than a bound.
struct Sure {
  double value, bound;
  bool negative() const { return value < -bound; }
  bool positive() const { return value > bound; }
  bool certain() const { return std::abs(value) > bound; }
};

/// The power of z to the other site less that to the owner. `off`: at most so far is z off.
///
/// A computed squared distance is off by 5u of itself (u = 2^-53: 2 for the difference squared, 1 for the
/// product, 2 sums), each of the three subtractions adds u of what it subtracts: less than 9u of all terms,
/// taken as 16u. Where z moves by `off` the lead moves by twice that times the distance of the two sites,
/// which is at most the sum of their distances from z, at most sqrt(2) times the root of the sum of squares,
/// and twice `off`.
inline Sure lead_of(const WeightedPoint3& owner, const WeightedPoint3& other, const Vec3& z, double off) {
  const double here2 = (z - owner.position).squaredNorm(), there2 = (z - other.position).squaredNorm();
  const double both2 = here2 + there2;
  return {(there2 - other.weight) - (here2 - owner.weight),
          0x1p-49 * (both2 + std::abs(other.weight) + std::abs(owner.weight)) +
              off * (3 * std::sqrt(both2) + 4 * off)};
}

}  // namespace geom
