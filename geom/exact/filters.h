#pragma once
// The filters of the exact predicates: determinants in doubles with a bound on their error.
//
// Bounds. Write the exact result as a sum of monomials in the inputs and let P be the sum of their absolute
// values (the permanent: the same expression with all products taken positive). Each rounding multiplies by
// 1 + d, |d| <= u = 2^-53. If every monomial passes at most k roundings on its way to the result, the result
// is off by at most ((1 + u)^k - 1) P. The computed permanent is at least (1 - u)^(k + 4) P, hence
//
//     |value - exact| <= (k + 1) u * (computed permanent),     with room to spare for every k < 10^6.
//
// k counts, along the longest path: 1 for each difference of inputs, 1 for each product (plus what its two
// factors have), 1 for each sum. In the valid range of expansion.h nothing underflows. If the bound is 0, all
// products are 0 and so is the exact result.

#include <cmath>

#include "geom/exact/predicates.h"

namespace geom::filter {

struct Estimate {
  double value, bound;

  bool certain() const { return value > bound || -value > bound || bound == 0; }
  int sign() const { return (value > 0) - (value < 0); }
};

constexpr double error_of(int roundings) { return (roundings + 1) * 0x1p-53; }

/// a b - c d and the sum of the two magnitudes.
struct Minor {
  double value, magnitude;
  Minor(double a, double b, double c, double d)
      : value(a * b - c * d), magnitude(std::abs(a * b) + std::abs(c * d)) {}
};

// Differences 1 + 1, product 1, sum 1: k = 4.
inline Estimate orient2(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Minor m(b.x() - a.x(), c.y() - a.y(), c.x() - a.x(), b.y() - a.y());
  return {m.value, error_of(4) * m.magnitude};
}

// A minor 4, a difference 1, product 1, sums 2: k = 8.
inline Estimate orient3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double px = b.x() - a.x(), py = b.y() - a.y(), pz = b.z() - a.z();
  const double qx = c.x() - a.x(), qy = c.y() - a.y(), qz = c.z() - a.z();
  const double rx = d.x() - a.x(), ry = d.y() - a.y(), rz = d.z() - a.z();
  const Minor x(qy, rz, qz, ry), y(qz, rx, qx, rz), z(qx, ry, qy, rx);
  const double permanent =
      std::abs(px) * x.magnitude + std::abs(py) * y.magnitude + std::abs(pz) * z.magnitude;
  return {px * x.value + py * y.value + pz * z.value, error_of(8) * permanent};
}

/// A point relative to another: the lift is |p - e|^2 - (w_p - w_e).
struct Lifted2 {
  double x, y, lift, magnitude;
  Lifted2(const WeightedPoint2& p, const WeightedPoint2& e)
      : x(p.position.x() - e.position.x()), y(p.position.y() - e.position.y()) {
    const double norm2 = x * x + y * y, heavier = p.weight - e.weight;
    lift = norm2 - heavier;
    magnitude = norm2 + std::abs(heavier);
  }
};
struct Lifted3 {
  double x, y, z, lift, magnitude;
  Lifted3(const WeightedPoint3& p, const WeightedPoint3& e)
      : x(p.position.x() - e.position.x()),
        y(p.position.y() - e.position.y()),
        z(p.position.z() - e.position.z()) {
    const double norm2 = x * x + y * y + z * z, heavier = p.weight - e.weight;
    lift = norm2 - heavier;
    magnitude = norm2 + std::abs(heavier);
  }
};

// A lift 2 + 1 + 1 + 1 = 5, a minor 4, product 1, sums 2: k = 12.
inline Estimate power_side2(const WeightedPoint2& a, const WeightedPoint2& b, const WeightedPoint2& c,
                            const WeightedPoint2& e) {
  const Lifted2 p(a, e), q(b, e), r(c, e);
  const Minor qr(q.x, r.y, q.y, r.x), rp(r.x, p.y, r.y, p.x), pq(p.x, q.y, p.y, q.x);
  const double permanent =
      p.magnitude * qr.magnitude + q.magnitude * rp.magnitude + r.magnitude * pq.magnitude;
  return {-(p.lift * qr.value + q.lift * rp.value + r.lift * pq.value), error_of(12) * permanent};
}

// A lift 2 + 1 + 2 + 1 = 6, a minor of three 8 as in orient3, product 1, sums 2: k = 17.
inline Estimate power_side3(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
                            const WeightedPoint3& d, const WeightedPoint3& e) {
  const Lifted3 p(a, e), q(b, e), r(c, e), s(d, e);
  const Minor pq(p.x, q.y, p.y, q.x), rs(r.x, s.y, r.y, s.x), pr(p.x, r.y, p.y, r.x), qs(q.x, s.y, q.y, s.x),
      ps(p.x, s.y, p.y, s.x), qr(q.x, r.y, q.y, r.x);
  const double pz = std::abs(p.z), qz = std::abs(q.z), rz = std::abs(r.z), sz = std::abs(s.z);
  const double qrs = q.z * rs.value - r.z * qs.value + s.z * qr.value;
  const double prs = p.z * rs.value - r.z * ps.value + s.z * pr.value;
  const double pqs = p.z * qs.value - q.z * ps.value + s.z * pq.value;
  const double pqr = p.z * qr.value - q.z * pr.value + r.z * pq.value;
  const double permanent = p.magnitude * (qz * rs.magnitude + rz * qs.magnitude + sz * qr.magnitude) +
                           q.magnitude * (pz * rs.magnitude + rz * ps.magnitude + sz * pr.magnitude) +
                           r.magnitude * (pz * qs.magnitude + qz * ps.magnitude + sz * pq.magnitude) +
                           s.magnitude * (pz * qr.magnitude + qz * pr.magnitude + rz * pq.magnitude);
  return {(q.lift * prs - p.lift * qrs) + (s.lift * pqr - r.lift * pqs), error_of(17) * permanent};
}

}  // namespace geom::filter
