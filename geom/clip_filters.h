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
// For error bounds see filters.h.

#include "geom/clip_predicates.h"
#include "geom/filters.h"

namespace geom::filter {

/// A rounded value and the sum of the magnitudes of its monomials.
struct Magnified {
  double value, magnitude;
};

/// (p0 - p_j) . d. Roundings: 1 + 1, product 1, sums 2: k = 5.
inline Magnified slope(const Vec3& p0, const Vec3& pj, const Vec3& d) {
  const double x = (p0.x() - pj.x()) * d.x(), y = (p0.y() - pj.y()) * d.y(), z = (p0.z() - pj.z()) * d.z();
  return {x + y + z, std::abs(x) + std::abs(y) + std::abs(z)};
}

/// F_j at q. Roundings: 1 + 2, product 1, sums 2, weights 1: k = 7.
inline Magnified form(const Vec3& q, const WeightedPoint3& p0, const WeightedPoint3& pj) {
  double value = 0, magnitude = 0;
  for (int i = 0; i < 3; ++i) {
    const double difference = p0.position[i] - pj.position[i];
    const double from_owner = q[i] - p0.position[i], from_j = q[i] - pj.position[i];
    value += difference * (from_owner + from_j);
    magnitude += std::abs(difference) * (std::abs(from_owner) + std::abs(from_j));
  }
  const double lighter = p0.weight - pj.weight;
  return {value + lighter, magnitude + std::abs(lighter)};
}

/// a b - c d. Roundings: those of two factors, product 1, sum 1.
inline Magnified minor(const Magnified& a, const Magnified& b, const Magnified& c, const Magnified& d) {
  return {a.value * b.value - c.value * d.value, a.magnitude * b.magnitude + c.magnitude * d.magnitude};
}

/// A corner test: the numerator has the sign of f_j there times that of the denominator.
struct CornerEstimate {
  Estimate numerator, denominator;
};

/// k = 7.
inline Estimate at_vertex(const Vec3& q, const WeightedPoint3& p0, const WeightedPoint3& j) {
  const Magnified f = form(q, p0, j);
  return {f.value, error_of(7) * f.magnitude};
}

/// k = 5 + 7 + 2 = 14 over 5.
inline CornerEstimate on_edge(const Vec3& a, const Vec3& b, const WeightedPoint3& p0,
                              const WeightedPoint3& first, const WeightedPoint3& j) {
  const Vec3 u = b - a;
  const Magnified s1 = slope(p0.position, first.position, u), s2 = slope(p0.position, j.position, u);
  const Magnified numerator = minor(s1, form(a, p0, j), form(a, p0, first), s2);
  return {{numerator.value, error_of(14) * numerator.magnitude}, {s1.value, error_of(5) * s1.magnitude}};
}

/// One affine function on the facet.
struct Row {
  Magnified f, s, t;
  Row(const Vec3& q0, const Vec3& u, const Vec3& v, const WeightedPoint3& p0, const WeightedPoint3& j)
      : f(form(q0, p0, j)), s(slope(p0.position, j.position, u)), t(slope(p0.position, j.position, v)) {}
};

/// Minors 5 + 5 + 2 = 12, F 7, product 1, sums 2: k = 22 over 12.
inline CornerEstimate in_facet(const FacetCorners& q, const WeightedPoint3& p0, const WeightedPoint3& first,
                               const WeightedPoint3& second, const WeightedPoint3& j) {
  const Vec3 u = *q.q1 - *q.q0, v = *q.q2 - *q.q0;
  const Row r1(*q.q0, u, v, p0, first), r2(*q.q0, u, v, p0, second), r3(*q.q0, u, v, p0, j);
  const Magnified m12 = minor(r1.s, r2.t, r1.t, r2.s), m23 = minor(r2.s, r3.t, r2.t, r3.s),
                  m31 = minor(r3.s, r1.t, r3.t, r1.s);
  const double value = r1.f.value * m23.value + r2.f.value * m31.value + r3.f.value * m12.value;
  const double magnitude =
      r1.f.magnitude * m23.magnitude + r2.f.magnitude * m31.magnitude + r3.f.magnitude * m12.magnitude;
  return {{value, error_of(22) * magnitude}, {m12.value, error_of(12) * m12.magnitude}};
}

/// s_b t_c - t_b s_c about a, the denominator above by itself. k = 12.
inline Estimate orientation(const FacetCorners& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = *q.q1 - *q.q0, v = *q.q2 - *q.q0;
  const Magnified m = minor(slope(a, b, u), slope(a, c, v), slope(a, b, v), slope(a, c, u));
  return {m.value, error_of(12) * m.magnitude};
}

}  // namespace geom::filter
