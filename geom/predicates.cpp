#include "geom/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/expansion.h"

namespace geom {
namespace {

// Filters: with u = 2^-53 each determinant below is computed with an error of at most k u times its permanent
// (the same expression with all products taken positive). Shewchuk derives 3, 7, 10 and 16 for the unweighted
// orient2, orient3, incircle and insphere; the subtraction of weights lengthens each lift by two roundings,
// and k is rounded up generously.
constexpr double u = 0x1p-53;
constexpr double orient2_bound = 4 * u, orient3_bound = 8 * u, side2_bound = 16 * u, side3_bound = 24 * u;

int sign(double x) { return (x > 0) - (x < 0); }

// The error is absolute in the permanent; if the permanent is 0, so is the determinant.
bool certain(double determinant, double bound) {
  return determinant > bound || -determinant > bound || bound == 0;
}

Expansion difference(double a, double b) { return Expansion::difference(a, b); }

/// a b - c d
Expansion minor(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d) {
  return a * b - c * d;
}

Expansion exact_orient2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return minor(difference(b.x(), a.x()), difference(c.y(), a.y()), difference(c.x(), a.x()),
               difference(b.y(), a.y()));
}

struct ExactVec3 {
  Expansion x, y, z;
  ExactVec3(const Vec3& p, const Vec3& origin)
      : x(difference(p.x(), origin.x())),
        y(difference(p.y(), origin.y())),
        z(difference(p.z(), origin.z())) {}
  Expansion norm2() const { return x * x + y * y + z * z; }
};

Expansion determinant(const ExactVec3& p, const ExactVec3& q, const ExactVec3& r) {
  return p.x * minor(q.y, r.z, q.z, r.y) + p.y * minor(q.z, r.x, q.x, r.z) + p.z * minor(q.x, r.y, q.y, r.x);
}

int exact_orient3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return determinant(ExactVec3(b, a), ExactVec3(c, a), ExactVec3(d, a)).sign();
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
  return -(p.lift * minor(q.x, r.y, q.y, r.x) + q.lift * minor(r.x, p.y, r.y, p.x) +
           r.lift * minor(p.x, q.y, p.y, q.x))
              .sign();
}

int exact_side3(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
                const WeightedPoint3& d, const WeightedPoint3& e) {
  const ExactVec3 p(a.position, e.position), q(b.position, e.position), r(c.position, e.position),
      s(d.position, e.position);
  const auto lift = [&](const ExactVec3& v, const WeightedPoint3& point) {
    return v.norm2() - difference(point.weight, e.weight);
  };
  return -(lift(p, a) * determinant(q, r, s) - lift(q, b) * determinant(p, r, s) +
           lift(r, c) * determinant(p, q, s) - lift(s, d) * determinant(p, q, r))
              .sign();
}

/// A coefficient of eps_rank in a perturbed value, or its sign.
struct ExactTie {
  std::int32_t rank;
  Expansion coefficient;
};
struct Tie {
  std::int32_t rank;
  int sign;
};

}  // namespace

int orient2(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y()), right = (c.x() - a.x()) * (b.y() - a.y());
  const double determinant = left - right, bound = orient2_bound * (std::abs(left) + std::abs(right));
  return certain(determinant, bound) ? sign(determinant) : exact_orient2(a, b, c).sign();
}

int orient3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = b - a, q = c - a, r = d - a;
  const double yz = q.y() * r.z(), zy = q.z() * r.y(), zx = q.z() * r.x(), xz = q.x() * r.z(),
               xy = q.x() * r.y(), yx = q.y() * r.x();
  const double determinant = p.x() * (yz - zy) + p.y() * (zx - xz) + p.z() * (xy - yx);
  const double permanent = std::abs(p.x()) * (std::abs(yz) + std::abs(zy)) +
                           std::abs(p.y()) * (std::abs(zx) + std::abs(xz)) +
                           std::abs(p.z()) * (std::abs(xy) + std::abs(yx));
  return certain(determinant, orient3_bound * permanent) ? sign(determinant) : exact_orient3(a, b, c, d);
}

// The lifted points (x, y, x^2 + y^2 - w) relative to e: e is below the plane of the others iff it is inside.
int power_side2(const WeightedPoint2& a, const WeightedPoint2& b, const WeightedPoint2& c,
                const WeightedPoint2& e) {
  const Vec2 p = a.position - e.position, q = b.position - e.position, r = c.position - e.position;
  const auto minor = [](const Vec2& s, const Vec2& t, double& magnitude) {
    const double left = s.x() * t.y(), right = s.y() * t.x();
    magnitude = std::abs(left) + std::abs(right);
    return left - right;
  };
  double m_qr, m_rp, m_pq;
  const double qr = minor(q, r, m_qr), rp = minor(r, p, m_rp), pq = minor(p, q, m_pq);
  const double p2 = p.squaredNorm(), q2 = q.squaredNorm(), r2 = r.squaredNorm();
  const double pw = a.weight - e.weight, qw = b.weight - e.weight, rw = c.weight - e.weight;
  const double determinant = (p2 - pw) * qr + (q2 - qw) * rp + (r2 - rw) * pq;
  const double permanent =
      (p2 + std::abs(pw)) * m_qr + (q2 + std::abs(qw)) * m_rp + (r2 + std::abs(rw)) * m_pq;
  return certain(determinant, side2_bound * permanent) ? -sign(determinant) : exact_side2(a, b, c, e);
}

int power_side3(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c,
                const WeightedPoint3& d, const WeightedPoint3& e) {
  const Vec3 p = a.position - e.position, q = b.position - e.position, r = c.position - e.position,
             s = d.position - e.position;
  const auto minor = [](const Vec3& v, const Vec3& w, double& magnitude) {
    const double left = v.x() * w.y(), right = v.y() * w.x();
    magnitude = std::abs(left) + std::abs(right);
    return left - right;
  };
  double m_pq, m_pr, m_ps, m_qr, m_qs, m_rs;
  const double pq = minor(p, q, m_pq), pr = minor(p, r, m_pr), ps = minor(p, s, m_ps), qr = minor(q, r, m_qr),
               qs = minor(q, s, m_qs), rs = minor(r, s, m_rs);
  const double az = std::abs(p.z()), bz = std::abs(q.z()), cz = std::abs(r.z()), dz = std::abs(s.z());
  const double qrs = q.z() * rs - r.z() * qs + s.z() * qr, m_qrs = bz * m_rs + cz * m_qs + dz * m_qr;
  const double prs = p.z() * rs - r.z() * ps + s.z() * pr, m_prs = az * m_rs + cz * m_ps + dz * m_pr;
  const double pqs = p.z() * qs - q.z() * ps + s.z() * pq, m_pqs = az * m_qs + bz * m_ps + dz * m_pq;
  const double pqr = p.z() * qr - q.z() * pr + r.z() * pq, m_pqr = az * m_qr + bz * m_pr + cz * m_pq;
  const double p2 = p.squaredNorm(), q2 = q.squaredNorm(), r2 = r.squaredNorm(), s2 = s.squaredNorm();
  const double pw = a.weight - e.weight, qw = b.weight - e.weight, rw = c.weight - e.weight,
               sw = d.weight - e.weight;
  const double determinant = (p2 - pw) * qrs - (q2 - qw) * prs + (r2 - rw) * pqs - (s2 - sw) * pqr;
  const double permanent = (p2 + std::abs(pw)) * m_qrs + (q2 + std::abs(qw)) * m_prs +
                           (r2 + std::abs(rw)) * m_pqs + (s2 + std::abs(sw)) * m_pqr;
  return certain(determinant, side3_bound * permanent) ? -sign(determinant) : exact_side3(a, b, c, d, e);
}

// The power of e with respect to the orthocircle, times the (positive) orientation, is affine in each weight
// w_i with the cofactor -+orient of the other points; w_i -> w_i + eps_i adds eps_i times that. For i = e it
// is -orient(a, b, c).
bool conflicts2(const RankedPoint2& a, const RankedPoint2& b, const RankedPoint2& c, const RankedPoint2& e) {
  if (const int side = power_side2(*a.point, *b.point, *c.point, *e.point); side != 0) return side < 0;
  const Vec2 &pa = a.point->position, &pb = b.point->position, &pc = c.point->position,
             &pe = e.point->position;
  std::array<ExactTie, 4> ties{
      ExactTie{a.rank, exact_orient2(pe, pb, pc)}, ExactTie{b.rank, exact_orient2(pe, pc, pa)},
      ExactTie{c.rank, exact_orient2(pe, pa, pb)}, ExactTie{e.rank, -exact_orient2(pa, pb, pc)}};
  std::ranges::sort(ties, {}, &ExactTie::rank);
  for (std::size_t i = 0, next; i < ties.size(); i = next) {  // copies of one site on a torus share one eps
    Expansion sum;
    for (next = i; next < ties.size() && ties[next].rank == ties[i].rank; ++next)
      sum = sum + ties[next].coefficient;
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
  Tie decisive{e.rank, -1};
  for (const auto& [rank, sign] :
       {Tie{a.rank, orient3(pe, pb, pc, pd)}, Tie{b.rank, orient3(pa, pe, pc, pd)},
        Tie{c.rank, orient3(pa, pb, pe, pd)}, Tie{d.rank, orient3(pa, pb, pc, pe)}})
    if (sign != 0 && rank < decisive.rank) decisive = {rank, sign};
  return decisive.sign < 0;
}

}  // namespace geom
