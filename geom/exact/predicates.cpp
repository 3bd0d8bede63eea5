#include "geom/exact/predicates.h"

#include <algorithm>
#include <array>

#include "geom/exact/exact_vector.h"
#include "geom/exact/filters.h"

namespace geom {
namespace {

Expansion difference(double a, double b) { return Expansion::difference(a, b); }

Expansion exact_orient2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return exact_minor(difference(b.x(), a.x()), difference(c.y(), a.y()), difference(c.x(), a.x()),
                     difference(b.y(), a.y()));
}

Expansion determinant(const ExactVec3& p, const ExactVec3& q, const ExactVec3& r) {
  return p.x * exact_minor(q.y, r.z, q.z, r.y) + p.y * exact_minor(q.z, r.x, q.x, r.z) +
         p.z * exact_minor(q.x, r.y, q.y, r.x);
}

int exact_orient3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return determinant(exact_difference(b, a), exact_difference(c, a), exact_difference(d, a)).sign();
}

int exact_side2(const WeightedPoint2& a, const WeightedPoint2& b, const WeightedPoint2& c,
                const WeightedPoint2& e) {
  struct Lifted {
    Expansion x, y, lift;
    Lifted(const WeightedPoint2& p, const WeightedPoint2& origin)
        : x(difference(p.position.x(), origin.position.x())),
          y(difference(p.position.y(), origin.position.y())),
          lift(x * x + y * y - difference(p.weight, origin.weight)) {}
  };
  const Lifted p(a, e), q(b, e), r(c, e);
  return -(p.lift * exact_minor(q.x, r.y, q.y, r.x) + q.lift * exact_minor(r.x, p.y, r.y, p.x) +
           r.lift * exact_minor(p.x, q.y, p.y, q.x))
              .sign();
}

int exact_side3(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
                const WeightedPoint3& d, const WeightedPoint3& e) {
  struct Lifted {
    ExactVec3 at;
    Expansion lift;
    Lifted(const WeightedPoint3& p, const WeightedPoint3& origin)
        : at(exact_difference(p.position, origin.position)),
          lift(dot(at, at) - difference(p.weight, origin.weight)) {}
  };
  const Lifted p(a, e), q(b, e), r(c, e), s(d, e);
  const Expansion pq = exact_minor(p.at.x, q.at.y, p.at.y, q.at.x),
                  rs = exact_minor(r.at.x, s.at.y, r.at.y, s.at.x),
                  pr = exact_minor(p.at.x, r.at.y, p.at.y, r.at.x),
                  qs = exact_minor(q.at.x, s.at.y, q.at.y, s.at.x),
                  ps = exact_minor(p.at.x, s.at.y, p.at.y, s.at.x),
                  qr = exact_minor(q.at.x, r.at.y, q.at.y, r.at.x);
  const Expansion qrs = q.at.z * rs - r.at.z * qs + s.at.z * qr;
  const Expansion prs = p.at.z * rs - r.at.z * ps + s.at.z * pr;
  const Expansion pqs = p.at.z * qs - q.at.z * ps + s.at.z * pq;
  const Expansion pqr = p.at.z * qr - q.at.z * pr + r.at.z * pq;
  return ((q.lift * prs - p.lift * qrs) + (s.lift * pqr - r.lift * pqs)).sign();
}

/// The orientation of three or four points, which multiplies eps_rank in a perturbed value.
struct Cofactor2 {
  std::int32_t rank;
  const Vec2 *p, *q, *r;
};
struct Cofactor3 {
  std::int32_t rank;
  const Vec3 *p, *q, *r, *s;
};

}  // namespace

int orient2(const Vec2& a, const Vec2& b, const Vec2& c) {
  const filter::Estimate estimate = filter::orient2(a, b, c);
  return estimate.certain() ? estimate.sign() : exact_orient2(a, b, c).sign();
}

int orient3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const filter::Estimate estimate = filter::orient3(a, b, c, d);
  return estimate.certain() ? estimate.sign() : exact_orient3(a, b, c, d);
}

int power_side2(const WeightedPoint2& a, const WeightedPoint2& b, const WeightedPoint2& c,
                const WeightedPoint2& e) {
  const filter::Estimate estimate = filter::power_side2(a, b, c, e);
  return estimate.certain() ? estimate.sign() : exact_side2(a, b, c, e);
}

int power_side3(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
                const WeightedPoint3& d, const WeightedPoint3& e) {
  const filter::Estimate estimate = filter::power_side3(a, b, c, d, e);
  return estimate.certain() ? estimate.sign() : exact_side3(a, b, c, d, e);
}

// The power of e with respect to the orthocircle, times the (positive) orientation, is affine in each weight
// w_i: w_i -> w_i + eps_i adds eps_i times the orientation of the triangle in which e stands for i; for i = e
// it subtracts eps_e times that of a, b, c. Equal ranks (copies of one site on a torus) share one eps.
bool conflicts2(const RankedPoint2& a, const RankedPoint2& b, const RankedPoint2& c, const RankedPoint2& e) {
  if (const int side = power_side2(*a.point, *b.point, *c.point, *e.point); side != 0) return side < 0;
  const Vec2 &pa = a.point->position, &pb = b.point->position, &pc = c.point->position,
             &pe = e.point->position;
  std::array<Cofactor2, 4> ties{
      {{a.rank, &pe, &pb, &pc}, {b.rank, &pa, &pe, &pc}, {c.rank, &pa, &pb, &pe}, {e.rank, &pb, &pa, &pc}}};
  std::ranges::sort(ties, {}, &Cofactor2::rank);
  for (auto tie = ties.begin(), next = tie; tie != ties.end(); tie = next) {
    while (next != ties.end() && next->rank == tie->rank) ++next;
    if (next - tie == 1) {
      if (const int sign = orient2(*tie->p, *tie->q, *tie->r); sign != 0) return sign < 0;
      continue;
    }
    Expansion sum;
    for (auto copy = tie; copy != next; ++copy) sum = sum + exact_orient2(*copy->p, *copy->q, *copy->r);
    if (sum.sign() != 0) return sum.sign() < 0;
  }
  return false;
}

bool conflicts3(const RankedPoint3& a, const RankedPoint3& b, const RankedPoint3& c, const RankedPoint3& d,
                const RankedPoint3& e) {
  if (const int side = power_side3(*a.point, *b.point, *c.point, *d.point, *e.point); side != 0)
    return side < 0;
  const Vec3 &pa = a.point->position, &pb = b.point->position, &pc = c.point->position,
             &pd = d.point->position, &pe = e.point->position;
  std::array<Cofactor3, 5> ties{{{a.rank, &pe, &pb, &pc, &pd},
                                 {b.rank, &pa, &pe, &pc, &pd},
                                 {c.rank, &pa, &pb, &pe, &pd},
                                 {d.rank, &pa, &pb, &pc, &pe},
                                 {e.rank, &pb, &pa, &pc, &pd}}};
  std::ranges::sort(ties, {}, &Cofactor3::rank);
  for (const Cofactor3& tie : ties)
    if (const int sign = orient3(*tie.p, *tie.q, *tie.r, *tie.s); sign != 0) return sign < 0;
  return false;
}

}  // namespace geom
