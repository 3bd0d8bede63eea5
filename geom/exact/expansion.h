#pragma once
// Exact arithmetic on doubles: a number is kept as a sum of doubles that do not overlap (Shewchuk, Adaptive
// Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997).
//
// Exact as long as nothing over- or underflows. In a polynomial of degree d in the inputs every intermediate
// value is a multiple of the d-th power of the inputs' common unit: with d <= 6, inputs that are multiples of
// 2^-160 and at most 2^160 in magnitude are safe (weights count twice: multiples of 2^-320, at most 2^320).

#include <array>
#include <cstddef>
#include <memory>

#ifdef __FAST_MATH__
#error "exact arithmetic needs IEEE rounding: do not compile with -ffast-math"
#endif

namespace geom {

class Expansion {
 public:
  Expansion() = default;
  explicit Expansion(double a);
  Expansion(const Expansion& other);
  Expansion(Expansion&& other) noexcept;
  Expansion& operator=(const Expansion& other) { return *this = Expansion(other); }
  Expansion& operator=(Expansion&& other) noexcept;

  /// a - b and a * b, exactly.
  static Expansion difference(double a, double b);
  static Expansion product(double a, double b);

  friend Expansion operator+(const Expansion& a, const Expansion& b) { return sum(a, b, 1); }
  friend Expansion operator-(const Expansion& a, const Expansion& b) { return sum(a, b, -1); }
  /// Cost: size of a times size of b.
  friend Expansion operator*(const Expansion& a, const Expansion& b);
  Expansion operator-() const;

  int sign() const;            ///< -1, 0, 1
  double approximate() const;  ///< the nearest double or its neighbour
  std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t inline_capacity = 16;

  const double* terms() const { return spilled_ ? spilled_.get() : inline_.data(); }
  double* terms() { return spilled_ ? spilled_.get() : inline_.data(); }
  double* make_room(std::size_t capacity);
  static Expansion sum(const Expansion& a, const Expansion& b, double sign_of_b);

  // Ascending in magnitude, not overlapping, none zero. Room for inline_capacity terms without allocation.
  std::size_t size_ = 0;
  std::unique_ptr<double[]> spilled_;
  std::array<double, inline_capacity> inline_;
};

/// Verifies that the compiled arithmetic is exact (no contraction to fused operations, no excess precision,
/// no flush to zero). Throws Bug. Every tool calls it at its start.
void self_test();

}  // namespace geom
