#pragma once
// The one place that rounds: bisectors evaluated in doubles and the corners of clipped facets, each with a
// proven bound on its error, so that clip.h can use them as a filter and turn to exact predicates only where
// the bound cannot tell.

#include <algorithm>
#include <array>
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
  double operator()(const Vec3& x) const { return along(x) - offset; }
  double operator()(const Location3& x) const { return (along(x.position) + rise * x.level) - offset; }
  /// normal . x, a term after the other.
  double along(const Vec3& x) const { return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2]; }
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
  const Vec3 &p = p0.position, &q = pj.position;
  const double dx = p[0] - q[0], dy = p[1] - q[1], dz = p[2] - q[2];
  const double dw = pj.weight - p0.weight;
  const double length = 2 * std::sqrt(dx * dx + dy * dy + dz * dz);
  const double difference =
      dx * (p[0] + q[0]) + dy * (p[1] + q[1]) + dz * (p[2] + q[2]);  // of |p|^2 and |q|^2
  const Vec3 normal(2 * dx, 2 * dy, 2 * dz);
  if (p0.level == pj.level)
    return {normal, difference + dw, length, 0x1p-48 * (length * extent + std::abs(dw))};
  const double rise = 2 * (p0.level - pj.level);
  return {normal, (difference + 0.5 * rise * (p0.level + pj.level)) + dw, length,
          0x1p-47 * ((length + std::abs(rise)) * extent + std::abs(dw)), rise};
}

/// Values of a bisector's f at the three corners of a facet, each off by at most `error`.
struct LinearForm {
  double f[3];
  double error;
};

/// The bisectors of p0 with two others, side by side in the lanes of one register, where all three have the
/// same level: the bits are those of bisector().
struct BisectorPair {
  using Two = Eigen::Array2d;
  Two x, y, z, offset, error;

  BisectorPair(const WeightedPoint3& p0, const WeightedPoint3& first, const WeightedPoint3& second,
               double extent) {
    const Vec3 &p = p0.position, &q = first.position, &r = second.position;
    const Two qx(q[0], r[0]), qy(q[1], r[1]), qz(q[2], r[2]);
    const Two dx = p[0] - qx, dy = p[1] - qy, dz = p[2] - qz;
    const Two dw = Two(first.weight, second.weight) - p0.weight;
    const Two length = 2 * (dx * dx + dy * dy + dz * dz).sqrt();
    offset = dx * (p[0] + qx) + dy * (p[1] + qy) + dz * (p[2] + qz) + dw;
    x = 2 * dx;
    y = 2 * dy;
    z = 2 * dz;
    error = 0x1p-48 * (length * extent + dw.abs());
  }
  Two operator()(const Vec3& at) const { return x * at[0] + y * at[1] + z * at[2] - offset; }
};

inline LinearForm linear_form(const Bisector& b, const Location3& q0, const Location3& q1,
                              const Location3& q2) {
  return {{b(q0), b(q1), b(q2)}, b.error};
}

/// Two forms side by side.
struct FormPair {
  Eigen::Array2d f[3];
  Eigen::Array2d error;
};

/// l = F1 x F2 for two forms on a facet: up to scale, the barycentric coordinates of where both vanish.
///
/// With m the largest value of each form, |dl_i| <= error = 2 (m1 e2 + m2 e1) + 4u m1 m2, and the sum is off
/// by at most sum_error = 3 error + 6u max |l_i|.
struct AxisMinors {
  double l[3], sum;
  double error, sum_error;
};

/// The l alone.
inline std::array<double, 3> axis_numbers(const FormPair& form) {
  const auto minor = [](const Eigen::Array2d& a, const Eigen::Array2d& b) {
    const Eigen::Array2d products = a * b.reverse();
    return products[0] - products[1];
  };
  return {minor(form.f[1], form.f[2]), minor(form.f[2], form.f[0]), minor(form.f[0], form.f[1])};
}

inline AxisMinors axis_minors(const FormPair& form, const std::array<double, 3>& l) {
  const Eigen::Array2d largest = form.f[0].abs().max(form.f[1].abs()).max(form.f[2].abs()) + form.error;
  const Eigen::Array2d crossed = largest * form.error.reverse();
  const double error = 2 * (crossed[0] + crossed[1]) + 4 * 0x1p-53 * largest[0] * largest[1];
  return {{l[0], l[1], l[2]}, l[0] + l[1] + l[2], error, 3 * error + 12 * 0x1p-53 * largest[0] * largest[1]};
}

inline AxisMinors axis_minors(const LinearForm& first, const LinearForm& second) {
  const FormPair pair{{{first.f[0], second.f[0]}, {first.f[1], second.f[1]}, {first.f[2], second.f[2]}},
                      {first.error, second.error}};
  return axis_minors(pair, axis_numbers(pair));
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
///
/// With D the sum of the l_i, x = sum (l_i / D) q_i. Since each exact l_i / D is in [0, 1], each rounded one
/// is off by at most (error + sum_error) / |D| + 4u. The factor 2 > sqrt(3) turns a bound of coordinates into
/// one of a distance.
inline RoundedPoint corner_in_facet(const Vec3& q0, const Vec3& q1, const Vec3& q2, const AxisMinors& minors,
                                    double extent) {
  constexpr double u = 0x1p-53;
  if (!(std::abs(minors.sum) > 4 * minors.sum_error))
    return {(q0 + q1 + q2) / 3, std::numeric_limits<double>::infinity()};
  const double inverse = 1 / minors.sum;
  const double b1 = std::clamp(minors.l[1] * inverse, 0.0, 1.0),
               b2 = std::clamp(minors.l[2] * inverse, 0.0, 1.0);
  RoundedPoint out;
  double first = 0, second = 0;  // the largest coordinates of the two edges
  for (int i = 0; i < 3; ++i) {
    const double along1 = q1[i] - q0[i], along2 = q2[i] - q0[i];
    out.position[i] = q0[i] + b1 * along1 + b2 * along2;
    first = std::max(first, std::abs(along1));
    second = std::max(second, std::abs(along2));
  }
  const double db = 1.01 * (minors.error + minors.sum_error) * std::abs(inverse) + 8 * u;
  out.tolerance = 2 * (db * (first + second) + 16 * u * extent);
  return out;
}

/// The same two points where the forms above are too uncertain: from exact values, rounded at the end. The
/// error is a few units in the last place of the facet's coordinates. Slow.
RoundedPoint exact_corner_on_edge(const Location3& a, const Location3& b, const RankedPoint3& owner,
                                  const RankedPoint3& j, double extent);
RoundedPoint exact_corner_in_facet(const Location3& at0, const Location3& at1, const Location3& at2,
                                   const RankedPoint3& owner, const RankedPoint3& first,
                                   const RankedPoint3& second, double extent);

}  // namespace geom
