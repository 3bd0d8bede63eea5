#pragma once
// The symbolic perturbation (geom/exact/predicates.h) made real: rational weights w + eps_rank so small and
// so far apart that CGAL, which knows nothing of the perturbation, finds no tie and has to agree.

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <cstdint>

#include "geom/vec.h"

namespace cgal {

using Number = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Number>;  ///< every number and decision exact, no filter

/// Coordinates and weights of what is perturbed are multiples of this and at most about 1.
inline constexpr double unit = 0x1p-60;
inline double rounded(double x) { return std::round(x / unit) * unit; }

/// 2^-(600 + 240 rank). A test's value is a polynomial of degree at most 5 in multiples of `unit`, linear in
/// the eps with coefficients of degree at most 3: not zero it exceeds 2^-300, a coefficient 2^-180. So eps_0
/// never overrules what is no tie, nor eps_(r + 1) what eps_r decides.
inline Number epsilon(std::int32_t rank) {
  Number result = 1, factor = Number(0.5);
  for (int exponent = 600 + 240 * rank; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result *= factor;
    factor *= factor;
  }
  return result;
}

inline Kernel::Weighted_point_3 perturbed(const geom::WeightedPoint3& p, std::int32_t rank) {
  return {Kernel::Point_3(p.position.x(), p.position.y(), p.position.z()), Number(p.weight) + epsilon(rank)};
}

}  // namespace cgal
