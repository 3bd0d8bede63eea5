#pragma once
// The circle orthogonal to the three weighted corners of a triangle: its center is a vertex of the power
// diagram.

#include <array>
#include <cmath>

#include "geom/ids.h"
#include "geom/regular/flat_torus.h"
#include "geom/vec.h"

namespace geom {

/// A weighted site of the flat torus as seen from an origin, by the shortest way.
struct SeenSite {
  double x, y, weight;
  SiteId id;
};

/// What is needed of a circle to see quickly who conflicts with it.
struct PowerCircle {
  double center_x, center_y;  ///< in [0, period], rounded
  double radius2;             ///< the power of the center to the corners
  float tolerance;            ///< of the filter: relative, or infinite if the center is not known well enough

  /// That of three sites. The first is `base`, whose place is `origin`; the others follow counterclockwise.
  /// `weight_allowance`: three times the largest |weight|.
  void set(const FlatTorus& torus, const Vec2& origin, const std::array<const SeenSite*, 3>& corners,
           double weight_allowance);

  /// -1: a site with that place and weight is inside, 1: it is not, 0: not known in doubles. A periodic copy
  /// nearer than the right one can only make a non-conflict a conflict.
  int side(const FlatTorus& torus, const Vec2& place, double weight, double weight_allowance) const {
    const double dx = torus.shortest_x(place.x() - center_x), dy = torus.shortest_y(place.y() - center_y);
    const double q = dx * dx + dy * dy, power = q - weight - radius2;
    const double most = tolerance * (q + std::abs(radius2) + weight_allowance);
    if (power > most) return 1;
    if (power < -most) return -1;
    return 0;
  }
};

// With the base at the origin and B = |b|^2 - w_b + w_a (same for C) the center o solves 2 o.b = B, 2 o.c =
// C.
//
// Error. The differences b and c are exact. Let m = |b|^2 + |c|^2 + 4 max|w|, s the sum of the |coordinates|
// of b and c, P = |bx cy| + |by cx|. B and C carry at most 4u m, the numerators 7u m s, D carries 3u P; so o
// is off by at most e0 = 16u (m s + P |o|) / D, and by 8u U more once it is stored and compared as a
// coordinate on the torus: e = e0 + 8u U. The power of x to the circle, |x - o|^2 - w_x - radius2, is linear
// in o once radius2 = |o|^2 - w_a is put in, so its error is 2 e |x - base| <= 2 e (q^1/2 + R) with
// q = |x - o|^2, R = |o|, which is <= e (3 R + q / R). If 3 e <= 2^-21 R this is <= 2^-21 (R^2 + q), and
// R^2 <= |radius2| + max|w|. Rounding of the evaluation itself, some u of the same terms, is far below
// another 2^-21 of them. Hence the relative tolerance 2^-20 of the filter in side().
inline void PowerCircle::set(const FlatTorus& torus, const Vec2& origin,
                             const std::array<const SeenSite*, 3>& corners, double weight_allowance) {
  constexpr double u = 0x1p-53;  // unit roundoff
  const SeenSite &base = *corners[0], &b = *corners[1], &c = *corners[2];
  const double bx = b.x - base.x, by = b.y - base.y, cx = c.x - base.x, cy = c.y - base.y;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double bw = b2 - (b.weight - base.weight), cw = c2 - (c.weight - base.weight);
  const double permanent = std::abs(bx * cy) + std::abs(by * cx);
  double det = bx * cy - by * cx;
  if (det <= 64 * u * permanent) {  // nearly flat: a determinant good to two ulps, at least the grid's square
    const double p = bx * cy, q = by * cx;
    det = (p - q) + (std::fma(bx, cy, -p) - std::fma(by, cx, -q));
  }
  const double scale = 0.5 / det;
  const double ox = (bw * cy - cw * by) * scale, oy = (cw * bx - bw * cx) * scale;
  const double o2 = ox * ox + oy * oy;

  const double m = b2 + c2 + 2 * weight_allowance,
               s = std::abs(bx) + std::abs(by) + std::abs(cx) + std::abs(cy);
  const double error =
      16 * u * (m * s + permanent * (std::abs(ox) + std::abs(oy))) + 8 * u * torus.unit() * det;
  const double bound = 3 * 0x1p21 * error;
  const bool sharp = bound * bound <= det * det * o2;

  center_x = torus.wrap_x(origin.x() + ox);
  center_y = torus.wrap_y(origin.y() + oy);
  if (!sharp) {
    const Vec2 far = torus.snap({center_x, center_y});
    center_x = far.x();
    center_y = far.y();
  }
  radius2 = o2 - base.weight;
  tolerance = sharp ? 0x1p-20f : INFINITY;
}

}  // namespace geom
