#pragma once
// Exact numbers for the oracles: integers of any size times a power of two. Doubles are such numbers, and
// sums, differences and products of them stay so.

#include <cstdint>
#include <span>
#include <vector>

namespace oracle {

/// sign * (sum of limbs[i] 2^(32 i)) * 2^(32 shift). Canonical: no zero limb at either end.
class Rational {
 public:
  Rational() = default;
  Rational(double value);  // NOLINT: every finite double is one
  static Rational power_of_two(long exponent);

  friend Rational operator+(const Rational& a, const Rational& b) { return sum(a, b, b.sign_); }
  friend Rational operator-(const Rational& a, const Rational& b) { return sum(a, b, -b.sign_); }
  friend Rational operator*(const Rational& a, const Rational& b);
  bool operator==(const Rational&) const = default;

  int sign() const { return sign_; }
  /// Within a relative 2^-50.
  double approximate() const;

 private:
  using Limbs = std::vector<std::uint32_t>;

  static Rational sum(const Rational& a, const Rational& b, int sign_of_b);
  void canonicalize();

  int sign_ = 0;
  long shift_ = 0;
  Limbs limbs_;  ///< least significant first
};

/// Laplace expansion along the first row. `rows` is square, row after row.
Rational determinant(std::span<const Rational> rows);

}  // namespace oracle
