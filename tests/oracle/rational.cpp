#include "tests/oracle/rational.h"

#include <algorithm>
#include <cmath>

namespace oracle {
namespace {

using Limbs = std::vector<std::uint32_t>;

/// Division that rounds down.
long floor_div(long a, long b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

/// Limb of a number whose lowest limb has place `shift`.
std::uint32_t limb_at(const Limbs& limbs, long shift, long place) {
  const long i = place - shift;
  return i < 0 || i >= static_cast<long>(limbs.size()) ? 0 : limbs[static_cast<std::size_t>(i)];
}

}  // namespace

Rational::Rational(double value) {
  if (value == 0) return;
  int exponent;
  const double fraction = std::frexp(std::abs(value), &exponent);
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
  shift_ = floor_div(exponent - 53, 32);
  const auto offset = static_cast<int>(exponent - 53 - 32 * shift_);
  const std::uint64_t low = (mantissa & 0xffffffffu) << offset, high = (mantissa >> 32) << offset;
  const std::uint64_t middle = (low >> 32) + (high & 0xffffffffu);
  sign_ = value > 0 ? 1 : -1;
  limbs_ = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(middle),
            static_cast<std::uint32_t>((high >> 32) + (middle >> 32))};
  canonicalize();
}

Rational Rational::power_of_two(long exponent) {
  Rational result;
  result.sign_ = 1;
  result.shift_ = floor_div(exponent, 32);
  result.limbs_ = {std::uint32_t{1} << (exponent - 32 * result.shift_)};
  return result;
}

void Rational::canonicalize() {
  while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  const auto first = std::ranges::find_if(limbs_, [](std::uint32_t limb) { return limb != 0; });
  shift_ = first == limbs_.end() ? 0 : shift_ + (first - limbs_.begin());
  limbs_.erase(limbs_.begin(), first);
  if (limbs_.empty()) sign_ = 0;
}

Rational Rational::sum(const Rational& a, const Rational& b, int sign_of_b) {
  Rational result;
  if (sign_of_b == 0) return a;
  if (a.sign_ == 0) {
    result = b;
    result.sign_ = sign_of_b;
    return result;
  }
  const long bottom = std::min(a.shift_, b.shift_);
  const long top =
      std::max(a.shift_ + static_cast<long>(a.limbs_.size()), b.shift_ + static_cast<long>(b.limbs_.size()));
  // Two's complement of the width top - bottom + 1; its last limb holds the sign.
  std::int64_t carry = 0;
  for (long place = bottom; place <= top; ++place) {
    carry += std::int64_t{a.sign_} * limb_at(a.limbs_, a.shift_, place);
    carry += std::int64_t{sign_of_b} * limb_at(b.limbs_, b.shift_, place);
    result.limbs_.push_back(static_cast<std::uint32_t>(carry));
    carry >>= 32;
  }
  result.shift_ = bottom;
  result.sign_ = carry < 0 ? -1 : 1;
  if (carry < 0) {
    std::uint64_t increment = 1;
    for (std::uint32_t& limb : result.limbs_) {
      increment += static_cast<std::uint32_t>(~limb);
      limb = static_cast<std::uint32_t>(increment);
      increment >>= 32;
    }
  }
  result.canonicalize();
  return result;
}

Rational operator*(const Rational& a, const Rational& b) {
  Rational result;
  if (a.sign_ == 0 || b.sign_ == 0) return result;
  result.sign_ = a.sign_ * b.sign_;
  result.shift_ = a.shift_ + b.shift_;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + result.limbs_[i + j];
      result.limbs_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    result.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  result.canonicalize();
  return result;
}

double Rational::approximate() const {
  double result = 0;
  const std::size_t used = std::min<std::size_t>(limbs_.size(), 4);
  for (std::size_t i = limbs_.size(); i-- > limbs_.size() - used;)
    result += std::ldexp(limbs_[i], static_cast<int>(32 * (shift_ + static_cast<long>(i))));
  return sign_ * result;
}

Rational determinant(std::span<const Rational> rows) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(rows.size()))));
  if (n == 1) return rows[0];
  Rational result;
  for (std::size_t column = 0; column < n; ++column) {
    std::vector<Rational> minor;
    for (std::size_t i = 1; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (j != column) minor.push_back(rows[i * n + j]);
    const Rational term = rows[column] * determinant(minor);
    result = column % 2 == 0 ? result + term : result - term;
  }
  return result;
}

}  // namespace oracle
