#pragma once
// The filters of the corner tests (clip_predicates.h), in the form that suits facets much smaller than cells.
//
// With base corner q0 and edges u = q1 - q0, v = q2 - q0 each affine function f_j is known by
//
//     F_j = Pi(q0, j) - Pi(q0, p0) = (p0 - p_j).((q0 - p0) + (q0 - p_j)) + (w_0 - w_j)
//     s_j = (p0 - p_j).u,    t_j = (p0 - p_j).v,      f_j(q0 + x u + y v) = F_j + 2 x s_j + 2 y t_j,
//
// and the determinants of clip_predicates.h become, up to powers of two,
//
//     B   s_1 F_2 - F_1 s_2   over   s_1           (edge q0 q1)
//     C   det(F, s, t), rows 1, 2, 3   over   s_1 t_2 - t_1 s_2.
//
// All points have four coordinates, the last one their level. For error bounds see filters.h. Real is double,
// or DoubleDouble where that cannot tell; then u is a bound of the error of one operation of those. Nothing
// underflows there either: rounding a multiple of a power of two leaves one, so all heads and tails are
// multiples of the inputs' common unit, to the degree of the value.

#include "geom/exact/double_double.h"
#include "geom/exact/filters.h"
#include "geom/power/clip_predicates.h"

namespace geom::filter {

template <class Real>
constexpr double error_in(int roundings) {
  return (roundings + 1) * unit_of<Real>;
}

/// A rounded value and the sum of the magnitudes of its monomials.
template <class Real>
struct Magnified {
  Real value;
  double magnitude;
  Estimate estimate(int roundings) const { return {rounded(value), error_in<Real>(roundings) * magnitude}; }
};

template <class Real>
struct Difference {
  Real x, y, z, level;
  Difference(const Location3& a, const Location3& b) {
    subtract(a.position.x(), b.position.x(), x);
    subtract(a.position.y(), b.position.y(), y);
    subtract(a.position.z(), b.position.z(), z);
    subtract(a.level, b.level, level);
  }
  Difference(const WeightedPoint3& a, const WeightedPoint3& b)
      : Difference(Location3(a.position, a.level), Location3(b.position, b.level)) {}
};

/// a . b. Roundings: those of two factors, product 1, sums 3.
template <class Real>
Magnified<Real> dot(const Difference<Real>& a, const Difference<Real>& b) {
  const Real x = a.x * b.x, y = a.y * b.y, z = a.z * b.z, level = a.level * b.level;
  return {x + y + z + level,
          std::abs(rounded(x)) + std::abs(rounded(y)) + std::abs(rounded(z)) + std::abs(rounded(level))};
}

/// (p0 - p_j) . d, for a difference d. k = 1 + 1 + 4 = 6.
template <class Real>
Magnified<Real> slope(const WeightedPoint3& p0, const WeightedPoint3& pj, const Difference<Real>& d) {
  return dot({p0, pj}, d);
}

/// F_j at q. Roundings: 1 + 2, product 1, sums 3, weights 1: k = 8.
template <class Real>
Magnified<Real> form(const Location3& q, const WeightedPoint3& p0, const WeightedPoint3& pj) {
  Real value, difference, from_owner, from_j;
  subtract(p0.weight, pj.weight, value);
  double magnitude = std::abs(rounded(value));
  const auto add = [&](double x, double own, double other) {
    subtract(own, other, difference);
    subtract(x, own, from_owner);
    subtract(x, other, from_j);
    value = value + difference * (from_owner + from_j);
    magnitude += std::abs(rounded(difference)) * (std::abs(rounded(from_owner)) + std::abs(rounded(from_j)));
  };
  for (int i = 0; i < 3; ++i) add(q.position[i], p0.position[i], pj.position[i]);
  add(q.level, p0.level, pj.level);
  return {value, magnitude};
}

/// a b - c d. Roundings: those of two factors, product 1, sum 1.
template <class Real>
Magnified<Real> minor(const Magnified<Real>& a, const Magnified<Real>& b, const Magnified<Real>& c,
                      const Magnified<Real>& d) {
  return {a.value * b.value - c.value * d.value, a.magnitude * b.magnitude + c.magnitude * d.magnitude};
}

/// A corner test: the numerator has the sign of f_j there times that of the denominator.
struct CornerEstimate {
  Estimate numerator, denominator;
};

/// k = 8.
template <class Real = double>
Estimate at_vertex(const Location3& q, const WeightedPoint3& p0, const WeightedPoint3& j) {
  return form<Real>(q, p0, j).estimate(8);
}

/// k = 6 + 8 + 2 = 16 over 6.
template <class Real = double>
CornerEstimate on_edge(const Location3& a, const Location3& b, const WeightedPoint3& p0,
                       const WeightedPoint3& first, const WeightedPoint3& j) {
  const Difference<Real> u(b, a);
  const Magnified<Real> s1 = slope(p0, first, u), s2 = slope(p0, j, u);
  return {minor(s1, form<Real>(a, p0, j), form<Real>(a, p0, first), s2).estimate(16), s1.estimate(6)};
}

/// One affine function on the facet.
template <class Real>
struct Row {
  Magnified<Real> f, s, t;
  Row(const Location3& q0, const Difference<Real>& u, const Difference<Real>& v, const WeightedPoint3& p0,
      const WeightedPoint3& j)
      : f(form<Real>(q0, p0, j)), s(slope(p0, j, u)), t(slope(p0, j, v)) {}
};

/// Minors 6 + 6 + 2 = 14, F 8, product 1, sums 2: k = 25 over 14.
template <class Real = double>
CornerEstimate in_facet(const FacetCorners& q, const WeightedPoint3& p0, const WeightedPoint3& first,
                        const WeightedPoint3& second, const WeightedPoint3& j) {
  const Location3 q0 = q.at(0);
  const Difference<Real> u(q.at(1), q0), v(q.at(2), q0);
  const Row<Real> r1(q0, u, v, p0, first), r2(q0, u, v, p0, second), r3(q0, u, v, p0, j);
  const Magnified<Real> m12 = minor(r1.s, r2.t, r1.t, r2.s), m23 = minor(r2.s, r3.t, r2.t, r3.s),
                        m31 = minor(r3.s, r1.t, r3.t, r1.s);
  const Magnified<Real> numerator{
      r1.f.value * m23.value + r2.f.value * m31.value + r3.f.value * m12.value,
      r1.f.magnitude * m23.magnitude + r2.f.magnitude * m31.magnitude + r3.f.magnitude * m12.magnitude};
  return {numerator.estimate(25), m12.estimate(14)};
}

}  // namespace geom::filter
