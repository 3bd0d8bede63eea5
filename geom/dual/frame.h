#pragma once
// A few sites seen from one of them, and their powers at the vertices of the surface: the doubles that the fast way of
// a move decides by, with a bound on their errors.
//
// Let p be the origin, y = z - p for a location z, d_i = p_i - p for a site i. The power of z to site i less that to the
// origin is
//
//     g_i(z) = Pi(z, p_i) - Pi(z, p) = c_i - 2 d_i.y,      c_i = |d_i|^2 - (w_i - w),
//
// affine in z. What decides is the sign of a g_i, of a difference of two, and of 2 x 2 determinants of such values.
//
// Errors. Let u = 2^-53. The components of d and y are rounded differences of doubles, off by u relatively. Hence
// |d|^2 is off by 5u |d|^2 (2 for the difference squared, 1 for the product, 2 sums), the difference of weights by
// u |dw|, c by u (6 |d|^2 + 2 |dw|) with its own rounding; 2 d.y by 10u |d| |y| (twice 2 for the factors, 1 for the
// product, 2 for the sums; the sum of |d_k y_k| is at most |d| |y|), and the last subtraction adds
// u (|d|^2 + |dw| + 2 |d| |y|):
//
//     |computed g_i - g_i| <= u (7 |d|^2 + 3 |dw| + 12 |d| |y|)   to first order,
//
// which the code takes as e = 16u (|d|^2 + |dw| + |d| |y|), with the largest |d| and |dw| of all sites and |y|_1 for
// |y|: room for higher orders and for the rounding of e itself. A difference of two values then is off by 2e + u times
// itself, less than 3e if it is no larger than a few |d|^2, and is taken to be certain beyond 4e.
//
// A determinant M = a b' - a' b of values at two vertices, each off by at most E at the one and E' at the other, is
// off by E (|b'| + |a'|) + E' (|a| + |b|) + 2 E E' + 3u (|a b'| + |a' b|) at most.
//
// Underflow does not count: coordinates and weights are in the valid range of predicates.h, whose products of two
// lengths do not underflow.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/trimesh.h"

namespace geom {

/// A value whose sign is certain if its magnitude is more than a bound.
struct Sure {
  double value, bound;
  bool negative() const { return value < -bound; }
  bool positive() const { return value > bound; }
  bool certain() const { return std::abs(value) > bound; }
};

class Frame {
 public:
  static constexpr int most = 16;  ///< sites, the origin left out
  using Slot = std::uint32_t;

  explicit Frame(const TriMesh& mesh) : mesh_(mesh), slot_of_(mesh.num_vertices(), 0) {}

  /// Starts anew, with no other site.
  void begin(const WeightedPoint3& origin);
  /// All before the first vertex. They are numbered 0, 1, ...
  void add(const WeightedPoint3& site);
  int size() const { return size_; }

  struct Vertex {
    VertexId id;
    bool owned;           ///< all g_i are positive: the origin is nearest
    bool sure;            ///< of the signs of all g_i
    bool sure_nearest;    ///< of `nearest`
    std::int8_t nearest;  ///< the site of least g_i
    std::uint32_t beaten_by;  ///< bit i: g_i < 0
    double error;         ///< e
    Vec3 y;
    double g[most];
  };
  /// The values at a vertex of the surface; valid until begin(). A reference is, until the next call.
  Slot at(VertexId v) {
    const Slot slot = slot_of_[v];
    if (slot < vertices_.size() && vertices_[slot].id == v) return slot;
    return evaluate(v);
  }
  const Vertex& vertex(Slot s) const { return vertices_[s]; }
  std::span<const Vertex> vertices() const { return vertices_; }

  /// Of two sites, or of one (j = none) and the origin, at a vertex: g_i - g_j.
  static constexpr int none = -1;
  static double value(const Vertex& v, int i) { return i == none ? 0 : v.g[i]; }
  static Sure difference(const Vertex& v, int i, int j) { return {value(v, i) - value(v, j), 4 * v.error}; }
  /// M = a(u) b(v) - a(v) b(u) for a = g_i - g_k, b = g_j - g_k.
  static Sure determinant(const Vertex& u, const Vertex& v, int i, int j, int k);

  /// The power of a location, off by at most `tolerance`, to a site given by its d and c, less that to site i.
  Sure lead(const Vec3& y, double tolerance, const Vec3& d, double c, int i) const;
  /// The same for a site of the frame.
  Sure lead(const Vec3& y, double tolerance, int j, int i) const {
    return j == none ? lead(y, tolerance, Vec3(0, 0, 0), 0, i) : lead(y, tolerance, offset(j), c_[j], i);
  }

  /// d_i, c_i, and the power of the location y to site i.
  Vec3 offset(int i) const { return {dx_[i], dy_[i], dz_[i]}; }
  double constant(int i) const { return c_[i]; }
  static Vec3 offset(const WeightedPoint3& site, const WeightedPoint3& origin) { return site.position - origin.position; }
  static double constant(const WeightedPoint3& site, const WeightedPoint3& origin) {
    return (site.position - origin.position).squaredNorm() - (site.weight - origin.weight);
  }
  double power(const Vec3& y, int i) const {
    return y.squaredNorm() - origin_.weight + (i == none ? 0 : c_[i] - 2 * (dx_[i] * y.x() + dy_[i] * y.y() + dz_[i] * y.z()));
  }
  const WeightedPoint3& origin() const { return origin_; }

 private:
  Slot evaluate(VertexId v);

  const TriMesh& mesh_;
  WeightedPoint3 origin_{{0, 0, 0}, 0};
  int size_ = 0, padded_ = 0;
  double largest2_ = 0, largest_ = 0, heaviest_ = 0;  ///< |d|^2, |d|, |dw|
  alignas(64) double dx_[most], dy_[most], dz_[most], c_[most];
  std::vector<Vertex> vertices_;
  Table<VertexId, Slot> slot_of_;  ///< if that slot says so, too
};

inline Sure Frame::determinant(const Vertex& u, const Vertex& v, int i, int j, int k) {
  const double a = value(u, i) - value(u, k), b = value(u, j) - value(u, k);
  const double a2 = value(v, i) - value(v, k), b2 = value(v, j) - value(v, k);
  const double e = 3 * u.error, e2 = 3 * v.error;
  return {a * b2 - a2 * b, e * (std::abs(a2) + std::abs(b2)) + e2 * (std::abs(a) + std::abs(b)) + 2 * e * e2 +
                               0x1p-51 * (std::abs(a * b2) + std::abs(a2 * b))};
}

}  // namespace geom
