#include "geom/power/construct.h"

#include <algorithm>
#include <cmath>

#include "geom/exact/exact_form.h"

namespace geom {
namespace {

constexpr double unit_roundoff = 0x1p-53;
constexpr double unknown = std::numeric_limits<double>::infinity();

// Coordinates are bounded one by one; the factor 2 > sqrt(3) in the tolerances turns that into a distance.

}  // namespace

// t = fa / (fa - fb). With errors |da|, |db| <= e and t in [0, 1], the rounded quotient differs from t by
// ((1 - t) da + t db) / (fa - fb), at most e / |fa - fb|, plus 2u for the subtraction and the division.
RoundedPoint corner_on_edge(const Vec3& a, const Vec3& b, double fa, double fb, double error, double extent) {
  const double difference = fa - fb;
  if (!(std::abs(difference) > 4 * error)) return {0.5 * (a + b), unknown};
  const double t = std::clamp(fa / difference, 0.0, 1.0);
  const Vec3 ab = b - a;
  const double dt = 1.01 * error / std::abs(difference) + 4 * unit_roundoff;
  return {a + t * ab, 2 * (dt * ab.lpNorm<Eigen::Infinity>() + 8 * unit_roundoff * extent)};
}

// Each exact value is rounded with a relative error of at most 2u, so a quotient in [0, 1] is off by 5u. With
// M the extent, a coordinate is off by 5u * 2M and another 5u M for a + t (b - a), or by 2 * 5u * 2M and
// another 12u M for q0 + b1 u + b2 v; times sqrt(3) that makes 26u M and 56u M.
RoundedPoint exact_corner_on_edge(const Location3& a, const Location3& b, const RankedPoint3& owner,
                                  const RankedPoint3& j, double extent) {
  const Expansion fa = form_at(a, owner, j), difference = fa - form_at(b, owner, j);
  const double t =
      difference.sign() == 0 ? 0.5 : std::clamp(fa.approximate() / difference.approximate(), 0.0, 1.0);
  return {a.position + t * (b.position - a.position), 32 * unit_roundoff * extent};
}

RoundedPoint exact_corner_in_facet(const Location3& at0, const Location3& at1, const Location3& at2,
                                   const RankedPoint3& owner, const RankedPoint3& first,
                                   const RankedPoint3& second, double extent) {
  const Vec3 &q0 = at0.position, &q1 = at1.position, &q2 = at2.position;
  const Expansion f[3] = {form_at(at0, owner, first), form_at(at1, owner, first), form_at(at2, owner, first)};
  const Expansion g[3] = {form_at(at0, owner, second), form_at(at1, owner, second),
                          form_at(at2, owner, second)};
  const Expansion l1 = f[2] * g[0] - f[0] * g[2], l2 = f[0] * g[1] - f[1] * g[0];
  const double sum = (f[1] * g[2] - f[2] * g[1] + l1 + l2).approximate();
  if (sum == 0) return {(q0 + q1 + q2) / 3, unknown};
  const double b1 = std::clamp(l1.approximate() / sum, 0.0, 1.0),
               b2 = std::clamp(l2.approximate() / sum, 0.0, 1.0);
  return {q0 + b1 * (q1 - q0) + b2 * (q2 - q0), 64 * unit_roundoff * extent};
}

}  // namespace geom
