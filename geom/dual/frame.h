#pragma once
// A few sites seen from one of them, and their powers at locations: the doubles that the fast way of a move
// decides by, with a bound on their errors.
//
// Let p be the origin, y = z - p for a location z, d_i = p_i - p for a site i. The power of z to site i less
// that to the origin is
//
//     g_i(z) = Pi(z, p_i) - Pi(z, p) = c_i - 2 d_i.y,      c_i = |d_i|^2 - (w_i - w),
//
// affine in z. Where the surface has levels (levels.h) a location and a site have a fourth coordinate: what
// is said here is of four, and `rise` is the fourth of y and of d_i. What decides is the sign of a g_i, of a
// difference of two, and of 2 x 2 determinants of such values.
//
// Errors. Let u = 2^-53. The components of d and y are rounded differences of doubles, off by u relatively.
// Hence |d|^2 is off by 5u |d|^2 (2 for the difference squared, 1 for the product, 2 sums), the difference of
// weights by u |dw|, c by u (6 |d|^2 + 2 |dw|) with its own rounding; 2 d.y by 10u |d| |y| (twice 2 for the
// factors, 1 for the product, 2 for the sums; the sum of |d_k y_k| is at most |d| |y|), and the last
// subtraction adds u (|d|^2 + |dw| + 2 |d| |y|):
//
//     |computed g_i - g_i| <= u (7 |d|^2 + 3 |dw| + 12 |d| |y|)   to first order,
//
// which the code takes as e = 16u (|d|^2 + |dw| + |d| |y|), with the largest |d| and |dw| of all sites and
// |y|_1 for |y|: room for higher orders and for the rounding of e itself. A difference of two values then is
// off by 2e + u times itself, less than 3e if it is no larger than a few |d|^2, and is taken to be certain
// beyond 4e. Of a location that is only known within a distance `off` all values move by 2 |d| off at most,
// which is added to e.
//
// A determinant M = a b' - a' b of values at two vertices, each off by at most E at the one and E' at the
// other, is off by E (|b'| + |a'|) + E' (|a| + |b|) + 2 E E' + 3u (|a b'| + |a' b|) at most.
//
// With levels the rises are a fourth term: |d|^2 is off by 6u |d|^2 then, c by u (7 |d|^2 + 2 |dw|), twice
// the product of two rises by 6u of itself, less than the 10u |d_k y_k| of the others. Subtracting it last
// adds u (|d|^2 + |dw| + 4 |d| |y|):
//
//     |computed g_i - g_i| <= u (9 |d|^2 + 4 |dw| + 16 |d| |y|)   to first order,
//
// which the code takes as 1.5 e, where not all sites have one level.
//
// Underflow does not count: coordinates and weights are in the valid range of predicates.h, whose products of
// two lengths do not underflow.

#include <algorithm>
#include <cmath>

#include "geom/dual/lead.h"

namespace geom {

class Frame {
 public:
  static constexpr int most = 16;  ///< sites, the origin left out
  static constexpr int few = 8;    ///< they are mostly

  /// Starts anew, with no other site.
  void begin(const WeightedPoint3& origin);
  /// They are numbered 0, 1, ... Values that are known already lack it.
  void add(const WeightedPoint3& site);
  int size() const { return size_; }
  /// Have all sites the level of the origin? Then the rise of a location does not matter.
  bool is_level() const { return is_level_; }
  /// d_i and c_i; beyond size(): no site, at infinity.
  struct Coefficients {
    alignas(64) double dx[most]{}, dy[most]{}, dz[most]{}, c[most]{};
    double rise[most]{};
  };
  /// A location, and a site, from the origin.
  struct Place {
    Place() = default;
    Place(const Vec3& y, double rise = 0) : y(y), rise(rise) {}
    Vec3 y;
    double rise = 0;
    double squaredNorm() const { return y.squaredNorm() + rise * rise; }
  };
  struct Seen {
    Vec3 d;
    double c;
    double rise = 0;
  };

  /// The values g_i at a location, and their error e.
  struct Values : Place {
    double error;
    int size;            ///< of the frame
    double g[most + 1];  ///< of no site: very much; the last one is that of the origin: 0
    bool nearer(int i, int j) const {
      return g[at(j)] - g[at(i)] > 4 * error;
    }  ///< certainly, i is nearer than j
    /// How many sites, it being one, are not certainly farther than site i, the origin left out.
    int num_not_farther(int i) const {
      const double least = g[at(i)] + 4 * error;
      int number = 0;
      for (int k = 0; k < few; ++k) number += !(g[at(k)] > least);
      for (int k = few; k < size; ++k) number += !(g[at(k)] > least);
      return number;
    }
    Sure difference(int i, int j) const { return {g[at(i)] - g[at(j)], 4 * error}; }
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  };
  /// The number of the origin as a site, and that of no site.
  static constexpr int none = most, nobody = -1;
  void evaluate(const Place& at, double off, Values& out) const;
  /// Is a site surely farther than one of these in all of the ball? `first`: the one that is tried first, if
  /// any; it may be the origin.
  bool is_behind(const Seen& site, const Place& center, double radius, int first) const;
  /// The same, of each location of the ball, by the nearer one of two sites with successive numbers.
  bool is_behind_two(const Seen& site, const Place& center, double radius) const;
  Sure difference(const Values& at, const Seen& site, int j) const;

  /// d_i, c_i, and the power of the location to site i.
  Vec3 offset(int i) const { return i == none ? Vec3(0, 0, 0) : Vec3(of_.dx[i], of_.dy[i], of_.dz[i]); }
  double constant(int i) const { return i == none ? 0 : of_.c[i]; }
  double rise(int i) const { return i == none ? 0 : of_.rise[i]; }
  Seen seen(int i) const { return {offset(i), constant(i), rise(i)}; }
  static Seen seen(const WeightedPoint3& site, const WeightedPoint3& origin) {
    const Vec3 d = site.position - origin.position;
    const double rise = site.level - origin.level;
    return {d, d.squaredNorm() + rise * rise - (site.weight - origin.weight), rise};
  }
  Place place_of(const SurfacePoint& z) const {
    return {z.position - origin_.position, z.level - origin_.level};
  }
  double power(const Place& at, int i) const {
    return at.squaredNorm() - origin_.weight + (constant(i) - 2 * (offset(i).dot(at.y) + rise(i) * at.rise));
  }
  const WeightedPoint3& origin() const { return origin_; }

 private:
  double error_at(const Vec3& twice_y, double twice_rise) const;

  WeightedPoint3 origin_{{0, 0, 0}, 0};
  int size_ = 0;
  bool is_level_ = true;
  double largest2_ = 0, largest_ = 0, heaviest_ = 0;  ///< |d|^2, |d|, |dw|
  Coefficients of_;
};

/// M = a(u) b(v) - a(v) b(u) for a = g_i - g_k, b = g_j - g_k.
inline Sure determinant(const Frame::Values& u, const Frame::Values& v, int i, int j, int k) {
  const std::size_t si = Frame::Values::at(i), sj = Frame::Values::at(j), sk = Frame::Values::at(k);
  const double a = u.g[si] - u.g[sk], b = u.g[sj] - u.g[sk];
  const double a2 = v.g[si] - v.g[sk], b2 = v.g[sj] - v.g[sk];
  const double e = 3 * u.error, e2 = 3 * v.error;
  return {a * b2 - a2 * b, e * (std::abs(a2) + std::abs(b2)) + e2 * (std::abs(a) + std::abs(b)) + 2 * e * e2 +
                               0x1p-51 * (std::abs(a * b2) + std::abs(a2 * b))};
}

}  // namespace geom
