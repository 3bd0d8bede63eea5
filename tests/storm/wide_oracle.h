#pragma once
// The geometric predicates in integers of any size: some microseconds a call, so that tens of millions of
// answers can be compared. The formulas are those of the corner values (clip_predicates.h: F, lambda, D), not
// the ones that geom/ evaluates; the perturbation is not read off cofactors either: every predicate is affine
// in the weights, so the coefficient of eps_r is what changes when the weights of rank r grow by one unit.

#include <span>

#include "geom/power/clip_predicates.h"
#include "tests/storm/wide.h"

namespace storm {

/// Coordinates as multiples of 2^unit, weights of 2^(2 unit).
struct WideSite {
  Wide x, y, z, weight;
  int rank = 0;

  WideSite() = default;
  WideSite(const geom::WeightedPoint3& p, long unit, int its_rank = 0)
      : x(p.position.x(), unit),
        y(p.position.y(), unit),
        z(p.position.z(), unit),
        weight(p.weight, 2 * unit),
        rank(its_rank) {}
};

/// The largest unit of which all coordinates and weights are multiples.
long common_unit(std::span<const geom::WeightedPoint3> points);

int orient2(const WideSite& a, const WideSite& b, const WideSite& c);
int orient3(const WideSite& a, const WideSite& b, const WideSite& c, const WideSite& d);

/// A sign, and whether it took the perturbation to find it. The sign of a tie may be 0 only if ranks are
/// equal.
struct Decision {
  int sign;
  bool tie;
};

/// The predicates of predicates.h, perturbed: a, b, c, e. Without perturbation the sign is tie ? 0 : sign.
Decision power_side2(std::span<const WideSite, 4> sites);
/// a, b, c, d, e.
Decision power_side3(std::span<const WideSite, 5> sites);

/// Pi(q, j) - Pi(q, i) in units of 2^(2 unit); the weight of the location q does not matter.
Wide power_difference(const WideSite& q, const WideSite& i, const WideSite& j);

/// The sign of Pi(q, j) - Pi(q, owner); sites: owner, j.
Decision at_vertex(const WideSite& q, std::span<const WideSite, 2> sites);
/// The same at the corner of type B; sites: owner, on_bisector, j. Sign 0 and no tie if there is no corner.
Decision on_edge(const WideSite& a, const WideSite& b, std::span<const WideSite, 3> sites);
/// And of type C; sites: owner, first, second, j.
Decision in_facet(std::span<const WideSite, 3> q, std::span<const WideSite, 4> sites);

}  // namespace storm
