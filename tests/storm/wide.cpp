#include "tests/storm/wide.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "geom/check.h"

namespace storm {
namespace {

using Double = unsigned __int128;

/// |value| = mantissa * 2^exponent with an odd mantissa. value is not 0.
std::pair<std::uint64_t, long> odd_mantissa(double value) {
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value), &exponent);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  const int zeros = std::countr_zero(mantissa);
  return {mantissa >> zeros, exponent - 53L + zeros};
}

}  // namespace

long lowest_bit(double value) { return value == 0 ? 1L << 20 : odd_mantissa(value).second; }

Wide::Wide(double value, long unit) {
  if (value == 0) return;
  const auto [mantissa, exponent] = odd_mantissa(value);
  geom::ensure(exponent >= unit, "wide: not a multiple of the unit");
  const auto shift = static_cast<std::size_t>(exponent - unit);
  for (std::size_t i = 0; i < shift / 64; ++i) push(0);
  const Double wide = Double{mantissa} << (shift % 64);
  push(static_cast<std::uint64_t>(wide));
  push(static_cast<std::uint64_t>(wide >> 64));
  sign_ = value > 0 ? 1 : -1;
  trim();
}

Wide& Wide::operator=(const Wide& other) {
  sign_ = other.sign_;
  size_ = other.size_;
  std::copy_n(other.limbs_.begin(), size_, limbs_.begin());
  return *this;
}

void Wide::push(std::uint64_t limb) {
  geom::ensure(size_ < capacity, "wide: too large");
  limbs_[size_++] = limb;
}

void Wide::trim() {
  while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
  if (size_ == 0) sign_ = 0;
}

int Wide::compare_magnitudes(const Wide& a, const Wide& b) {
  if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
  for (std::size_t i = a.size_; i-- > 0;)
    if (a.limbs_[i] != b.limbs_[i]) return a.limbs_[i] < b.limbs_[i] ? -1 : 1;
  return 0;
}

void Wide::add_magnitudes(const Wide& a, const Wide& b, Wide& out) {
  const Wide &longer = a.size_ >= b.size_ ? a : b, &shorter = a.size_ >= b.size_ ? b : a;
  Double carry = 0;
  for (std::size_t i = 0; i < longer.size_; ++i) {
    carry += longer.limbs_[i];
    if (i < shorter.size_) carry += shorter.limbs_[i];
    out.limbs_[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  out.size_ = longer.size_;
  if (carry != 0) out.push(1);
}

void Wide::subtract_magnitudes(const Wide& larger, const Wide& smaller, Wide& out) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < larger.size_; ++i) {
    const Double taken = Double{i < smaller.size_ ? smaller.limbs_[i] : 0} + borrow;
    borrow = larger.limbs_[i] < taken;
    out.limbs_[i] = larger.limbs_[i] - static_cast<std::uint64_t>(taken);
  }
  out.size_ = larger.size_;
}

Wide Wide::sum(const Wide& a, const Wide& b, int sign_of_b) {
  Wide result;
  if (sign_of_b == 0) return a;
  if (a.sign_ == 0) {
    result = b;
    result.sign_ = sign_of_b;
  } else if (a.sign_ == sign_of_b) {
    add_magnitudes(a, b, result);
    result.sign_ = a.sign_;
  } else if (const int order = compare_magnitudes(a, b); order != 0) {
    subtract_magnitudes(order > 0 ? a : b, order > 0 ? b : a, result);
    result.sign_ = order > 0 ? a.sign_ : sign_of_b;
    result.trim();
  }
  return result;
}

Wide operator*(const Wide& a, const Wide& b) {
  Wide result;
  if (a.sign_ == 0 || b.sign_ == 0) return result;
  geom::ensure(a.size_ + b.size_ <= Wide::capacity, "wide: too large");
  result.sign_ = a.sign_ * b.sign_;
  result.size_ = a.size_ + b.size_;
  std::fill_n(result.limbs_.begin(), result.size_, 0);
  for (std::size_t i = 0; i < a.size_; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.size_; ++j) {
      const Double t = Double{a.limbs_[i]} * b.limbs_[j] + result.limbs_[i + j] + carry;
      result.limbs_[i + j] = static_cast<std::uint64_t>(t);
      carry = static_cast<std::uint64_t>(t >> 64);
    }
    result.limbs_[i + b.size_] = carry;
  }
  result.trim();
  return result;
}

}  // namespace storm
