#include "geom/expansion.h"

#include <cmath>
#include <limits>

#include "geom/check.h"

namespace geom {
namespace {

/// head + tail equals the exact result, head is the rounded one.
struct TwoTerms {
  double head, tail;
};

TwoTerms two_sum(double a, double b) {
  const double head = a + b, b_part = head - a, a_part = head - b_part;
  return {head, (a - a_part) + (b - b_part)};
}

/// Requires |a| >= |b| or a = 0.
TwoTerms fast_two_sum(double a, double b) {
  const double head = a + b;
  return {head, b - (head - a)};
}

/// Dekker's product: each factor is split into two halves of 26 bits, the products of which are exact.
TwoTerms two_product(double a, double b) {
  const double head = a * b;
#ifdef FP_FAST_FMA
  return {head, std::fma(a, b, -head)};
#else
  constexpr double splitter = 0x1p27 + 1;
  const double ca = splitter * a, a_high = ca - (ca - a), a_low = a - a_high;
  const double cb = splitter * b, b_high = cb - (cb - b), b_low = b - b_high;
  return {head, a_low * b_low - (((head - a_high * b_high) - a_low * b_high) - a_high * b_low)};
#endif
}

}  // namespace

Expansion::Expansion(double a) { push(inline_.data(), a); }

double* Expansion::reserve(std::size_t capacity) {
  if (capacity <= inline_capacity) return inline_.data();
  spilled_.resize(capacity);
  return spilled_.data();
}

Expansion Expansion::difference(double a, double b) {
  const TwoTerms t = two_sum(a, -b);
  Expansion result(t.tail);
  result.push(result.inline_.data(), t.head);
  return result;
}

Expansion Expansion::product(double a, double b) {
  const TwoTerms t = two_product(a, b);
  Expansion result(t.tail);
  result.push(result.inline_.data(), t.head);
  return result;
}

Expansion Expansion::operator-() const {
  Expansion result = *this;
  double* terms = result.spilled_.empty() ? result.inline_.data() : result.spilled_.data();
  for (std::size_t i = 0; i < size_; ++i) terms[i] = -terms[i];
  return result;
}

/// Shewchuk's fast expansion sum with zero elimination: merge by magnitude, then carry upwards.
Expansion Expansion::sum(const Expansion& a, const Expansion& b, double sign_of_b) {
  if (b.size_ == 0) return a;
  if (a.size_ == 0) return sign_of_b < 0 ? -b : b;
  Expansion result;
  double* out = result.reserve(a.size_ + b.size_);
  const double *p = a.terms(), *p_end = p + a.size_, *q = b.terms(), *q_end = q + b.size_;
  const auto next = [&] {
    if (q == q_end || (p != p_end && std::abs(*p) < std::abs(*q))) return *p++;
    return sign_of_b * *q++;
  };
  const double first = next();
  TwoTerms carry = fast_two_sum(next(), first);
  result.push(out, carry.tail);
  while (p != p_end || q != q_end) {
    carry = two_sum(carry.head, next());
    result.push(out, carry.tail);
  }
  result.push(out, carry.head);
  return result;
}

Expansion operator+(const Expansion& a, const Expansion& b) { return Expansion::sum(a, b, 1); }
Expansion operator-(const Expansion& a, const Expansion& b) { return Expansion::sum(a, b, -1); }

/// Shewchuk's scale expansion.
Expansion Expansion::scaled(double factor) const {
  Expansion result;
  if (size_ == 0 || factor == 0) return result;
  double* out = result.reserve(2 * size_);
  const double* e = terms();
  TwoTerms carry = two_product(e[0], factor);
  result.push(out, carry.tail);
  for (std::size_t i = 1; i < size_; ++i) {
    const TwoTerms product = two_product(e[i], factor);
    const TwoTerms low = two_sum(carry.head, product.tail);
    result.push(out, low.tail);
    carry = fast_two_sum(product.head, low.head);
    result.push(out, carry.tail);
  }
  result.push(out, carry.head);
  return result;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
  const Expansion &shorter = a.size_ <= b.size_ ? a : b, &longer = a.size_ <= b.size_ ? b : a;
  Expansion result;
  for (std::size_t i = 0; i < shorter.size_; ++i) result = result + longer.scaled(shorter.terms()[i]);
  result.compress();
  return result;
}

/// Shewchuk's compression: a pass down that gathers the value in as few terms as possible, a pass up that
/// drops the zeros.
void Expansion::compress() {
  if (size_ < 2) return;
  double* e = spilled_.empty() ? inline_.data() : spilled_.data();
  std::size_t bottom = size_ - 1;
  double q = e[bottom];
  for (std::size_t i = size_ - 1; i-- > 0;) {
    const TwoTerms t = fast_two_sum(q, e[i]);
    q = t.head;
    if (t.tail != 0) {
      e[bottom--] = t.head;
      q = t.tail;
    }
  }
  e[bottom] = q;
  std::size_t top = 0;
  for (std::size_t i = bottom + 1; i < size_; ++i) {
    const TwoTerms t = fast_two_sum(e[i], q);
    q = t.head;
    if (t.tail != 0) e[top++] = t.tail;
  }
  e[top++] = q;
  size_ = q == 0 ? 0 : top;
}

int Expansion::sign() const {
  if (size_ == 0) return 0;
  return terms()[size_ - 1] > 0 ? 1 : -1;
}

double Expansion::approximate() const {
  double result = 0;
  for (std::size_t i = 0; i < size_; ++i) result += terms()[i];
  return result;
}

void self_test() {
  // Volatile: computed at run time, by the instructions the predicates use.
  volatile double one = 1, tiny = 0x1p-53, third = 1.0 / 3, smallest = std::numeric_limits<double>::min();
  const TwoTerms sum = two_sum(one, tiny);
  ensure(sum.head == 1 && sum.tail == 0x1p-53, "arithmetic self-test: sums are not rounded to double");
  // Contracted to fma(a, b, -c) this would be the rounding error of the product, not zero.
  const double a = third, b = third, c = a * b;
  ensure(a * b - c == 0, "arithmetic self-test: products are contracted into fused operations");
  const TwoTerms square = two_product(a, b);
  ensure(square.tail != 0 && (Expansion::product(a, b) - Expansion(square.head)).approximate() == square.tail,
         "arithmetic self-test: the tail of a product is wrong");
  ensure(smallest / 2 > 0 && smallest / 2 * 2 == smallest,
         "arithmetic self-test: denormals are flushed to zero");
}

}  // namespace geom
