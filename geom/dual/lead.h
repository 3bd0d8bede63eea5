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

/// A location of the surface and its level, which is off by so much at most, in four coordinates.
struct SurfacePoint {
  Vec3 position;
  double level, off;
};

/// A site as it is seen from locations of one level, of which it need not be: its weight is less by the
/// square of the difference, and rounded up.
inline WeightedPoint3 seen_from(double level, const WeightedPoint3& site) {
  if (site.level == level) return site;
  const double gap2 = (level - site.level) * (level - site.level);
  return {site.position, site.weight - gap2 + 0x1p-50 * (std::abs(site.weight) + gap2), level};
}

/// The same where the two have different levels. `level_off`: at most so far is the level of z off.
inline Sure lead_of(const WeightedPoint3& owner, const WeightedPoint3& other, const Location3& z, double off,
                    double level_off) {
  const auto shifted = [&](const WeightedPoint3& p) {
    return WeightedPoint3{p.position, p.weight - (z.level - p.level) * (z.level - p.level)};
  };
  Sure lead = lead_of(shifted(owner), shifted(other), z.position, off);
  const double here = std::abs(z.level - owner.level), there = std::abs(z.level - other.level);
  lead.bound += 0x1p-49 * (here * here + there * there + std::abs(owner.weight) + std::abs(other.weight)) +
                2 * level_off * (here + there + level_off);
  return lead;
}

/// The same, whether or not they have.
inline Sure lead_of(const WeightedPoint3& owner, const WeightedPoint3& other, const SurfacePoint& z) {
  return owner.level == other.level ? lead_of(owner, other, z.position, z.off)
                                    : lead_of(owner, other, Location3(z.position, z.level), z.off, z.off);
}

/// Is that lead surely positive? Mostly that is plain: with `off` at most 2^-20 times the root of both
/// squared distances the bound is at most 2^-18 times these, and what the weights add.
inline bool leads(const WeightedPoint3& owner, const WeightedPoint3& other, const SurfacePoint& z) {
  if (owner.level == other.level && owner.weight == other.weight) {
    const double here2 = (z.position - owner.position).squaredNorm(),
                 there2 = (z.position - other.position).squaredNorm(), both2 = here2 + there2;
    if (there2 - here2 > 0x1p-17 * both2 + 0x1p-47 * std::abs(owner.weight) &&
        z.off * z.off <= 0x1p-40 * both2)
      return true;
  }
  return lead_of(owner, other, z).positive();
}

}  // namespace geom
