#include "tests/oracle/predicates_oracle.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace oracle {
namespace {

Rational norm2(const ExactSite& p) { return p.x * p.x + p.y * p.y + p.z * p.z + p.level * p.level; }
Rational dot(const ExactSite& p, const HomogeneousPoint& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z + p.level * q.level;
}

/// w (Pi(q, j) - Pi(q, i)) = -2 q.(p_j - p_i) + w (|p_j|^2 - w_j - |p_i|^2 + w_i) for the point q / w.
Rational power_difference(const HomogeneousPoint& q, const ExactSite& i, const ExactSite& j) {
  return q.w * ((norm2(j) - j.weight) - (norm2(i) - i.weight)) - Rational(2) * (dot(j, q) - dot(i, q));
}

HomogeneousPoint combine(const Rational& s, const HomogeneousPoint& a, const Rational& t,
                         const HomogeneousPoint& b) {
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z, s + t, s * a.level + t * b.level};
}

}  // namespace

void Scale::cover(double x, int degree) {
  if (x == 0) return;
  int exponent;
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  const long lowest = exponent - 53 + std::countr_zero(mantissa);
  unit_ = std::max(unit_, (-lowest + degree - 1) / degree);
  size_ = std::max(size_, (exponent + degree - 1L) / degree);
}

void Scale::cover(const geom::WeightedPoint3& p) {
  for (const double x : p.position) cover_coordinate(x);
  cover_coordinate(p.level);
  cover_weight(p.weight);
}

Rational Scale::epsilon(int rank) const {
  return Rational::power_of_two(-(rank + 1) * (6 * (unit_ + size_) + 64));
}

ExactSite exact_site(const geom::WeightedPoint3& p) {
  return {p.position.x(), p.position.y(), p.position.z(), p.weight, p.level};
}
ExactSite exact_site(const geom::WeightedPoint2& p) { return {p.position.x(), p.position.y(), 0, p.weight}; }
ExactSite lifted(ExactSite site, const Rational& epsilon) {
  site.weight = site.weight + epsilon;
  return site;
}

// | 1 x y |, rows a, b, c: the determinant of the differences from the first row.
int orient2(const ExactSite& a, const ExactSite& b, const ExactSite& c) {
  return determinant(std::array<Rational, 9>{1, a.x, a.y, 1, b.x, b.y, 1, c.x, c.y}).sign();
}

int orient3(const ExactSite& a, const ExactSite& b, const ExactSite& c, const ExactSite& d) {
  return determinant(
             std::array<Rational, 16>{1, a.x, a.y, a.z, 1, b.x, b.y, b.z, 1, c.x, c.y, c.z, 1, d.x, d.y, d.z})
      .sign();
}

// The height of the lifted point e over the plane of the others: | 1 x y lift |, e last, has the sign of that
// height times the orientation of the others.
int power_side2(const ExactSite& a, const ExactSite& b, const ExactSite& c, const ExactSite& e) {
  std::vector<Rational> rows;
  for (const ExactSite* p : {&a, &b, &c, &e})
    rows.insert(rows.end(), {Rational(1), p->x, p->y, norm2(*p) - p->weight});
  return determinant(rows).sign();
}

int power_side3(const ExactSite& a, const ExactSite& b, const ExactSite& c, const ExactSite& d,
                const ExactSite& e) {
  std::vector<Rational> rows;
  for (const ExactSite* p : {&a, &b, &c, &d, &e})
    rows.insert(rows.end(), {Rational(1), p->x, p->y, p->z, norm2(*p) - p->weight});
  return determinant(rows).sign();
}

HomogeneousPoint at(const geom::Location3& q) {
  return {q.position.x(), q.position.y(), q.position.z(), 1, q.level};
}

// The power difference is affine along the line, hence zero at f_b a - f_a b.
HomogeneousPoint on_edge(const geom::Location3& a, const geom::Location3& b, const ExactSite& i,
                         const ExactSite& j) {
  const Rational fa = power_difference(at(a), i, j), fb = power_difference(at(b), i, j);
  return combine(fb, at(a), Rational() - fa, at(b));
}

// q0 + s (q1 - q0) + t (q2 - q0) with f + s f_1 + t f_2 = 0 and g + s g_1 + t g_2 = 0, by Cramer's rule.
HomogeneousPoint in_facet(const geom::FacetCorners& facet, const ExactSite& i, const ExactSite& j,
                          const ExactSite& k) {
  const HomogeneousPoint q0 = at(facet.at(0)), q1 = at(facet.at(1)), q2 = at(facet.at(2));
  const Rational f = power_difference(q0, i, j), g = power_difference(q0, i, k);
  const Rational f1 = power_difference(q1, i, j) - f, f2 = power_difference(q2, i, j) - f;
  const Rational g1 = power_difference(q1, i, k) - g, g2 = power_difference(q2, i, k) - g;
  const Rational w = f1 * g2 - f2 * g1, s = f2 * g - f * g2, t = f * g1 - f1 * g;
  const auto coordinate = [&](const Rational& c0, const Rational& c1, const Rational& c2) {
    return w * c0 + s * (c1 - c0) + t * (c2 - c0);
  };
  return {coordinate(q0.x, q1.x, q2.x), coordinate(q0.y, q1.y, q2.y), coordinate(q0.z, q1.z, q2.z), w,
          coordinate(q0.level, q1.level, q2.level)};
}

int compare_powers(const HomogeneousPoint& point, const ExactSite& i, const ExactSite& j) {
  return power_difference(point, i, j).sign() * point.w.sign();
}

}  // namespace oracle
