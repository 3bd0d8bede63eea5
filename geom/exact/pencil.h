#pragma once
// The orthospheres through three weighted points a, b, c: a filter that compares many fourth points at once.
//
// Let B = b - a, C = c - a, E = e - a and let beta, gamma, epsilon be the lifts |B|^2 - (w_b - w_a) and so
// on. With
//
//     n = B x C,     m = beta (C x n) + gamma (n x B),     so that  m.B = beta |n|^2,  m.C = gamma |n|^2, m.n
//     = 0,
//
// each point e has a height H = n.E over the plane of a, b, c and an offset N = |n|^2 epsilon - m.E, |n|^2
// times its power with respect to the smallest orthosphere through a, b, c (less its weight). The orthosphere
// through a, b, c and d, H_d positive, has power N - (N_d / H_d) H times 1 / |n|^2 there: so e lies inside
// iff N_e H_d - N_d H_e < 0, and the points with H > 0 are ordered by N / H, the least one's orthosphere
// excluding the others.
//
// Errors. Let every operation, and the differences of inputs, have relative error at most u; let |.| be the
// largest component, G = |B| |C|, L = 3 |.|^2 + |difference of weights| (no less than the lift), K = L_b |C|
// + L_c |B|. To first order, components and sums bounded by the sums of magnitudes:
//
//     n        <= 2 G each,           error  8 u G
//     lift     <= L,                  error  7 u L
//     C x n    <= 4 G |C|, n x B alike, error 28 u G |C|
//     m        <= 4 G K,              error (28 + 28 + 4 + 4) u G K = 64 u G K
//     |n|^2    <= 12 G^2,             error 132 u G^2
//     H        <= 6 G |E|,            error 3 (8 + 8) u G |E| = 48 u G |E|                         -> 64
//     N        <= 12 G (G L_e + K |E|), error 228 u G^2 L_e + 240 u G K |E| + 12 u (...)           -> 300
//
// The last column, which the code uses, has room for the higher orders and for the rounding of the bounds
// themselves. Underflow adds nothing that counts while all lengths are within 2^-80 .. 2^80; beyond that
// nothing is certain.

#include <algorithm>
#include <cmath>
#include <limits>

#include "geom/exact/double_double.h"
#include "geom/vec.h"

namespace geom {

/// Real: double, or DoubleDouble where that cannot tell.
template <class Real>
class Pencil {
 public:
  /// Where a point lies in the pencil, with bounds on the errors.
  struct Place {
    Real height, offset;
    double height_error, offset_error;
  };

  Pencil(const WeightedPoint3& a, const WeightedPoint3& b, const WeightedPoint3& c) : a_(a) {
    const Arm to_b(b, a), to_c(c, a);
    const Triple &B = to_b.at, &C = to_c.at;
    normal_ = cross(B, C);
    const Triple cn = cross(C, normal_), nb = cross(normal_, B);
    tilt_ = {to_b.lift * cn.x + to_c.lift * nb.x, to_b.lift * cn.y + to_c.lift * nb.y,
             to_b.lift * cn.z + to_c.lift * nb.z};
    normal2_ = dot(normal_, normal_);
    const double g = to_b.size * to_c.size, k = to_b.lift_size * to_c.size + to_c.lift_size * to_b.size;
    height_factor_ = in_range(to_b) && in_range(to_c) ? 64 * u * g : std::numeric_limits<double>::infinity();
    lift_factor_ = 300 * u * g * g;
    arm_factor_ = 300 * u * g * k;
  }

  Place place(const WeightedPoint3& e) const {
    const Arm to_e(e, a_);
    const double height_error =
        in_range(to_e) ? height_factor_ * to_e.size : std::numeric_limits<double>::infinity();
    return {dot(normal_, to_e.at), normal2_ * to_e.lift - dot(tilt_, to_e.at), height_error,
            lift_factor_ * to_e.lift_size + arm_factor_ * to_e.size};
  }

  /// The sign of the height, 0 if uncertain.
  static int side(const Place& e) {
    const double h = rounded(e.height);
    return (h > e.height_error) - (h < -e.height_error);
  }

  /// -1 if e is certainly inside the orthosphere through a, b, c and d, +1 if certainly outside, 0 if
  /// uncertain. The height of d is known to be positive.
  static int power_side(const Place& d, const Place& e) {
    const Real left = e.offset * d.height, right = d.offset * e.height;
    const double power = rounded(left - right);
    const double dh = std::abs(rounded(d.height)), eh = std::abs(rounded(e.height));
    const double error = (std::abs(rounded(e.offset)) + e.offset_error) * d.height_error +
                         dh * e.offset_error +
                         (std::abs(rounded(d.offset)) + d.offset_error) * e.height_error +
                         eh * d.offset_error + 3 * u * (std::abs(rounded(left)) + std::abs(rounded(right)));
    return (power > 1.01 * error) - (power < -1.01 * error);
  }

 private:
  static constexpr double u = unit_of<Real>;

  struct Triple {
    Real x, y, z;
  };
  /// A point relative to a.
  struct Arm {
    Triple at;
    Real lift;
    double size, lift_size;

    Arm(const WeightedPoint3& p, const WeightedPoint3& a) {
      Real heavier;
      subtract(p.position.x(), a.position.x(), at.x);
      subtract(p.position.y(), a.position.y(), at.y);
      subtract(p.position.z(), a.position.z(), at.z);
      subtract(p.weight, a.weight, heavier);
      lift = dot(at, at) - heavier;
      size = std::max({std::abs(rounded(at.x)), std::abs(rounded(at.y)), std::abs(rounded(at.z))});
      lift_size = 3 * size * size + std::abs(rounded(heavier));
    }
  };

  static bool in_range(const Arm& arm) { return arm.size > 0x1p-80 && arm.lift_size < 0x1p160; }
  static Real dot(const Triple& v, const Triple& w) { return v.x * w.x + v.y * w.y + v.z * w.z; }
  static Triple cross(const Triple& v, const Triple& w) {
    return {v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};
  }

  WeightedPoint3 a_;
  Triple normal_, tilt_;
  Real normal2_;
  double height_factor_, lift_factor_, arm_factor_;
};

}  // namespace geom
