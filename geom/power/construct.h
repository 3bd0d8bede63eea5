#pragma once
// The one place that rounds: bisectors evaluated in doubles and the corners of clipped facets, each with a
// proven bound on its error, so that clip.h can use them as a filter and turn to exact predicates only where
// the bound cannot tell.

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/exact/predicates.h"

namespace geom {

/// The affine function f(x) = Pi(x, j) - Pi(x, p0) of two weighted points: negative where j beats the owner
/// p0. f(x) = normal . x - offset, normal = 2 (p0 - pj), offset = (p0 - pj).(p0 + pj) + wj - w0.
struct Bisector {
  Vec3 normal;
  double offset;
  double length;    ///< |normal|
  double error;     ///< |computed f(x) - f(x)| <= error for every double x with |x|_inf <= extent
  double rise = 0;  ///< the fourth coordinate of the normal: 0 if the two have the same level

  /// At a location of any level, if rise is 0.
  double operator()(const Vec3& x) const { return normal.dot(x) - offset; }
  double operator()(const Location3& x) const { return (normal.dot(x.position) + rise * x.level) - offset; }
  /// How fast f can change, a level being as good as a length.
  double steepness() const { return rise == 0 ? length : std::hypot(length, rise) * (1 + 0x1p-50); }
};

/// `extent` bounds every coordinate of p0, pj and of the locations at which f will be evaluated.
///
/// Error: let u = 2^-53, n the normal, |.|_1 the sum of magnitudes, M the extent. The rounded normal . x is
/// off by at most 4u |n|_1 M (a difference, a product, two sums), (p0 - pj).(p0 + pj) by 5u |n|_1 M, dw by
/// u |dw|, their sum by u (|n|_1 M + |dw|), the last subtraction by u (2 |n|_1 M + |dw|): together
/// u (12 |n|_1 M + 3 |dw|) to first order. As |n|_1 <= sqrt(3) |n|, 32u (|n| M + |dw|) leaves a third for the
/// higher orders and the rounding of the bound.
/// With levels, which `extent` bounds, too, there is one more term of each sum, at most 5u |n|_1 M + ... of
/// it: twice the bound is enough.
inline Bisector bisector(const WeightedPoint3& p0, const WeightedPoint3& pj, double extent) {
  const Vec3 d = p0.position - pj.position, s = p0.position + pj.position;
  const double dw = pj.weight - p0.weight;
  const double length = 2 * d.norm();
  if (p0.level == pj.level) return {2 * d, d.dot(s) + dw, length, 0x1p-48 * (length * extent + std::abs(dw))};
  const double rise = 2 * (p0.level - pj.level);
  return {2 * d, (d.dot(s) + 0.5 * rise * (p0.level + pj.level)) + dw, length,
          0x1p-47 * ((length + std::abs(rise)) * extent + std::abs(dw)), rise};
}

/// Values of a bisector's f at the three corners of a facet, each off by at most `error`.
struct LinearForm {
  double f[3];
  double error;
};

inline LinearForm linear_form(const Bisector& b, const Location3& q0, const Location3& q1,
                              const Location3& q2) {
  return {{b(q0), b(q1), b(q2)}, b.error};
}

/// l = F1 x F2 for two forms on a facet: up to scale, the barycentric coordinates of where both vanish.
///
/// With m the largest value of each form, |dl_i| <= error = 2 (m1 e2 + m2 e1) + 4u m1 m2, and the sum is off
/// by at most sum_error = 3 error + 6u max |l_i|.
struct AxisMinors {
  double l[3], sum;
  double error, sum_error;
};

inline AxisMinors axis_minors(const LinearForm& first, const LinearForm& second) {
  const double* f = first.f;
  const double* g = second.f;
  const auto largest = [](const LinearForm& form) {
    return std::max(std::max(std::abs(form.f[0]), std::abs(form.f[1])), std::abs(form.f[2])) + form.error;
  };
  const double l0 = f[1] * g[2] - f[2] * g[1], l1 = f[2] * g[0] - f[0] * g[2], l2 = f[0] * g[1] - f[1] * g[0];
  const double m1 = largest(first), m2 = largest(second);
  const double error = 2 * (m1 * second.error + m2 * first.error) + 4 * 0x1p-53 * m1 * m2;
  return {{l0, l1, l2}, l0 + l1 + l2, error, 3 * error + 12 * 0x1p-53 * m1 * m2};
}

/// A rounded location: the exact one is at most `tolerance` away (infinity: unknown, but both lie in the
/// facet).
struct RoundedPoint {
  Vec3 position;
  double tolerance;
};

/// The point of segment (a, b) where a linear form with end values fa, fb (each off by at most `error`)
/// vanishes. Requires that the exact form vanishes between a and b. To get the same bits from both facets at
/// an edge, pass the end of smaller mesh-vertex id first.
RoundedPoint corner_on_edge(const Vec3& a, const Vec3& b, double fa, double fb, double error, double extent);

/// The point of facet (q0, q1, q2) where two linear forms vanish, given their minors. Requires that the exact
/// point lies in the facet. A function of the arguments in this order: make the forms with the site of
/// smaller id first.
RoundedPoint corner_in_facet(const Vec3& q0, const Vec3& q1, const Vec3& q2, const AxisMinors& minors,
                             double extent);

/// The same two points where the forms above are too uncertain: from exact values, rounded at the end. The
/// error is a few units in the last place of the facet's coordinates. Slow.
RoundedPoint exact_corner_on_edge(const Location3& a, const Location3& b, const RankedPoint3& owner,
                                  const RankedPoint3& j, double extent);
RoundedPoint exact_corner_in_facet(const Location3& at0, const Location3& at1, const Location3& at2,
                                   const RankedPoint3& owner, const RankedPoint3& first,
                                   const RankedPoint3& second, double extent);

}  // namespace geom
