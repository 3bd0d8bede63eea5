#pragma once
// Integers of thousands of bits without allocation: the arithmetic of the fast oracle. It shares nothing with
// geom/exact/expansion.h (no floating-point operation happens after the conversion) nor with
// tests/oracle/rational.h, which it is checked against.

#include <array>
#include <cstddef>
#include <cstdint>

namespace storm {

/// sign * sum of limbs[i] 2^(64 i). Throws geom::Bug if a result needs more than `capacity` limbs. Cost: sums
/// linear, products quadratic in the limbs in use.
class Wide {
 public:
  static constexpr std::size_t capacity = 200;

  Wide() = default;
  /// value / 2^unit, which must be an integer.
  Wide(double value, long unit);
  static Wide one() { return {1, 0}; }
  Wide(const Wide& other) { *this = other; }
  Wide& operator=(const Wide& other);

  friend Wide operator+(const Wide& a, const Wide& b) { return sum(a, b, b.sign_); }
  friend Wide operator-(const Wide& a, const Wide& b) { return sum(a, b, -b.sign_); }
  friend Wide operator*(const Wide& a, const Wide& b);
  Wide twice() const { return *this + *this; }
  int sign() const { return sign_; }

 private:
  static Wide sum(const Wide& a, const Wide& b, int sign_of_b);
  static int compare_magnitudes(const Wide& a, const Wide& b);
  static void add_magnitudes(const Wide& a, const Wide& b, Wide& out);
  static void subtract_magnitudes(const Wide& larger, const Wide& smaller, Wide& out);
  void push(std::uint64_t limb);
  void trim();

  int sign_ = 0;
  std::size_t size_ = 0;
  std::array<std::uint64_t, capacity> limbs_;  ///< least significant first, the last of those in use not zero
};

/// The least e such that value is a multiple of 2^e; a large number for 0.
long lowest_bit(double value);

}  // namespace storm
