#pragma once
// A few sites seen from one of them, and their powers at locations: the doubles that the fast way of a move
// decides by, with a bound on their errors.
//
// Let p be the origin, y = z - p for a location z, d_i = p_i - p for a site i. The power of z to site i less
// that to the origin is
//
//     g_i(z) = Pi(z, p_i) - Pi(z, p) = c_i - 2 d_i.y,      c_i = |d_i|^2 - (w_i - w),
//
// affine in z. What decides is the sign of a g_i, of a difference of two, and of 2 x 2 determinants of such
// values.
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
// Underflow does not count: coordinates and weights are in the valid range of predicates.h, whose products of
// two lengths do not underflow.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "geom/dual/lead.h"
#include "geom/mesh/trimesh.h"
#include "geom/reused.h"

namespace geom {

class Frame {
 public:
  static constexpr int most = 16;  ///< sites, the origin left out
  using Slot = std::uint32_t;

  explicit Frame(const TriMesh& mesh) : mesh_(mesh), slot_of_(mesh.num_vertices(), 0) {}

  /// Starts anew, with no other site.
  void begin(const WeightedPoint3& origin);
  /// All before the first location. They are numbered 0, 1, ...
  void add(const WeightedPoint3& site);
  /// One more, after locations.
  void add_late(const WeightedPoint3& site);
  int size() const { return size_; }

  /// The values g_i at a location y, and their error e.
  struct Values {
    Vec3 y;
    double error;
    double g[most + 1];  ///< the last one is that of the origin: 0
    bool nearer(int i, int j) const {
      return g[at(j)] - g[at(i)] > 4 * error;
    }  ///< certainly, i is nearer than j
    Sure difference(int i, int j) const { return {g[at(i)] - g[at(j)], 4 * error}; }
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  };
  /// The number of the origin as a site, and that of no site.
  static constexpr int none = most, nobody = -1;
  void evaluate(const Vec3& y, double off, Values& out) const;
  /// Is a site given by its d and c surely farther than one of these in all of the ball? `first`: the one
  /// that is tried first, if any; it may be the origin.
  bool is_behind(const Vec3& d, double c, const Vec3& center, double radius, int first) const;
  /// The same, of each location of the ball, by the nearer one of two sites with successive numbers.
  bool is_behind_two(const Vec3& d, double c, const Vec3& center, double radius) const;
  /// Of a site given by its d and c.
  Sure difference(const Values& at, const Vec3& d, double c, int j) const;

  struct Vertex : Values {
    VertexId id;
    bool has_signs;                                ///< these are known:
    bool sure;                                     ///< of the signs of all g_i
    std::uint32_t beaten_by;                       ///< bit i: g_i < 0
    bool owned() const { return beaten_by == 0; }  ///< the origin is nearest
  };
  /// The values at a vertex of the surface; valid until begin(). A reference is, until the next call.
  Slot at(VertexId v) {
    const Slot slot = slot_of_[v];
    if (slot < vertices_.size() && vertices_[slot].id == v) return slot;
    return evaluate(v);
  }
  const Vertex& vertex(Slot s) const { return vertices_[s]; }
  /// The same with all signs.
  Slot with_signs(VertexId v) {
    const Slot slot = at(v);
    if (!vertices_[slot].has_signs) find_signs(vertices_[slot]);
    return slot;
  }
  /// The site of least g_i, if that is certain; else -1.
  int nearest(const Vertex& v) const;
  std::size_t num_vertices() const { return vertices_.size(); }

  /// M = a(u) b(v) - a(v) b(u) for a = g_i - g_k, b = g_j - g_k.
  static Sure determinant(const Values& u, const Values& v, int i, int j, int k);

  /// d_i, c_i, and the power of the location y to site i.
  Vec3 offset(int i) const { return i == none ? Vec3(0, 0, 0) : Vec3(dx_[i], dy_[i], dz_[i]); }
  double constant(int i) const { return i == none ? 0 : c_[i]; }
  static Vec3 offset(const WeightedPoint3& site, const WeightedPoint3& origin) {
    return site.position - origin.position;
  }
  static double constant(const WeightedPoint3& site, const WeightedPoint3& origin) {
    return (site.position - origin.position).squaredNorm() - (site.weight - origin.weight);
  }
  double power(const Vec3& y, int i) const {
    return y.squaredNorm() - origin_.weight + (constant(i) - 2 * offset(i).dot(y));
  }
  const WeightedPoint3& origin() const { return origin_; }

 private:
  Slot evaluate(VertexId v);
  void find_signs(Vertex& v) const;
  double error_at(const Vec3& twice_y) const;
  template <int count>
  bool is_behind_one_of(const Vec3& d, double base, const Vec3& twice_center, double limit2) const;
  template <int count>
  void fill(double x2, double y2, double z2, double* out) const;

  const TriMesh& mesh_;
  WeightedPoint3 origin_{{0, 0, 0}, 0};
  int size_ = 0;
  double largest2_ = 0, largest_ = 0, heaviest_ = 0;             ///< |d|^2, |d|, |dw|
  alignas(64) double dx_[most], dy_[most], dz_[most], c_[most];  ///< beyond size_: no site, at infinity
  Reused<Vertex> vertices_;
  Table<VertexId, Slot> slot_of_;  ///< if that slot says so, too
};

inline Sure Frame::determinant(const Values& u, const Values& v, int i, int j, int k) {
  const std::size_t si = Values::at(i), sj = Values::at(j), sk = Values::at(k);
  const double a = u.g[si] - u.g[sk], b = u.g[sj] - u.g[sk];
  const double a2 = v.g[si] - v.g[sk], b2 = v.g[sj] - v.g[sk];
  const double e = 3 * u.error, e2 = 3 * v.error;
  return {a * b2 - a2 * b, e * (std::abs(a2) + std::abs(b2)) + e2 * (std::abs(a) + std::abs(b)) + 2 * e * e2 +
                               0x1p-51 * (std::abs(a * b2) + std::abs(a2 * b))};
}

}  // namespace geom
