#include "geom/exact/expansion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

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

/// A sum of doubles under construction: zeros are left out.
struct Writer {
  double* terms;
  std::size_t size = 0;
  void push(double term) {
    terms[size] = term;
    size += term != 0;
  }
};

/// Doubles for a while.
class Scratch {
 public:
  double* take(std::size_t count) {
    if (used_ + count <= local_.size()) return local_.data() + std::exchange(used_, used_ + count);
    return spilled_.emplace_back(new double[count]).get();
  }

 private:
  std::size_t used_ = 0;
  std::array<double, 160> local_;
  std::vector<std::unique_ptr<double[]>> spilled_;
};

struct Terms {
  const double* begin;
  std::size_t size;
};

/// Shewchuk's fast expansion sum with zero elimination: merge by magnitude, then carry upwards. `out` has
/// room for both.
std::size_t add(Terms a, Terms b, double sign_of_b, double* out) {
  Writer result{out};
  if (a.size + b.size < 2) {
    for (std::size_t i = 0; i < a.size; ++i) result.push(a.begin[i]);
    for (std::size_t i = 0; i < b.size; ++i) result.push(sign_of_b * b.begin[i]);
    return result.size;
  }
  const double *p = a.begin, *p_end = p + a.size, *q = b.begin, *q_end = q + b.size;
  const auto next = [&] {
    if (q == q_end || (p != p_end && std::abs(*p) < std::abs(*q))) return *p++;
    return sign_of_b * *q++;
  };
  const double first = next();
  TwoTerms carry = fast_two_sum(next(), first);
  result.push(carry.tail);
  while (p != p_end || q != q_end) {
    carry = two_sum(carry.head, next());
    result.push(carry.tail);
  }
  result.push(carry.head);
  return result.size;
}

/// Shewchuk's scale expansion. `out` has room for twice as many terms, at least one.
std::size_t scale(Terms a, double factor, double* out) {
  Writer result{out};
  TwoTerms carry = two_product(a.begin[0], factor);
  result.push(carry.tail);
  for (std::size_t i = 1; i < a.size; ++i) {
    const TwoTerms product = two_product(a.begin[i], factor);
    const TwoTerms low = two_sum(carry.head, product.tail);
    result.push(low.tail);
    carry = fast_two_sum(product.head, low.head);
    result.push(carry.tail);
  }
  result.push(carry.head);
  return result.size;
}

/// Shewchuk's compression, in place: a pass down that gathers the value in as few terms as possible, a pass
/// up that drops the zeros.
std::size_t compress(double* e, std::size_t size) {
  if (size < 2) return size;
  std::size_t bottom = size - 1;
  double q = e[bottom];
  for (std::size_t i = size - 1; i-- > 0;) {
    const TwoTerms t = fast_two_sum(q, e[i]);
    q = t.head;
    if (t.tail != 0) {
      e[bottom--] = t.head;
      q = t.tail;
    }
  }
  e[bottom] = q;
  std::size_t top = 0;
  for (std::size_t i = bottom + 1; i < size; ++i) {
    const TwoTerms t = fast_two_sum(e[i], q);
    q = t.head;
    if (t.tail != 0) e[top++] = t.tail;
  }
  e[top++] = q;
  return q == 0 ? 0 : top;
}

}  // namespace

Expansion::Expansion(double a) : size_(a != 0) { inline_[0] = a; }

Expansion::Expansion(const Expansion& other) : size_(other.size_) {
  std::copy_n(other.terms(), size_, make_room(size_));
}

Expansion::Expansion(Expansion&& other) noexcept : size_(other.size_), spilled_(std::move(other.spilled_)) {
  if (!spilled_) std::copy_n(other.inline_.data(), size_, inline_.data());
  other.size_ = 0;
}

Expansion& Expansion::operator=(Expansion&& other) noexcept {
  size_ = std::exchange(other.size_, 0);
  spilled_ = std::move(other.spilled_);
  if (!spilled_) std::copy_n(other.inline_.data(), size_, inline_.data());
  return *this;
}

double* Expansion::make_room(std::size_t capacity) {
  if (capacity > inline_capacity) spilled_.reset(new double[capacity]);
  return terms();
}

Expansion Expansion::difference(double a, double b) {
  const TwoTerms t = two_sum(a, -b);
  Expansion result;
  Writer writer{result.inline_.data()};
  writer.push(t.tail);
  writer.push(t.head);
  result.size_ = writer.size;
  return result;
}

Expansion Expansion::product(double a, double b) { return Expansion(a) * Expansion(b); }

Expansion Expansion::operator-() const {
  Expansion result = *this;
  std::transform(terms(), terms() + size_, result.terms(), std::negate());
  return result;
}

Expansion Expansion::sum(const Expansion& a, const Expansion& b, double sign_of_b) {
  if (b.size_ == 0) return a;
  if (a.size_ == 0) return sign_of_b < 0 ? -b : b;
  Scratch scratch;
  double* terms = scratch.take(a.size_ + b.size_);
  Expansion result;
  result.size_ = compress(terms, add({a.terms(), a.size_}, {b.terms(), b.size_}, sign_of_b, terms));
  std::copy_n(terms, result.size_, result.make_room(result.size_));
  return result;
}

Expansion operator*(const Expansion& a, const Expansion& b) {
  Expansion result;
  if (a.size_ == 0 || b.size_ == 0) return result;
  const Expansion &shorter = a.size_ <= b.size_ ? a : b, &longer = a.size_ <= b.size_ ? b : a;
  const std::size_t room = 2 * a.size_ * b.size_;
  Scratch scratch;
  double *total = scratch.take(room), *next = scratch.take(room), *row = scratch.take(2 * longer.size_);
  const Terms factor{longer.terms(), longer.size_};
  std::size_t size = scale(factor, shorter.terms()[0], total);
  for (std::size_t i = 1; i < shorter.size_; ++i) {
    const std::size_t row_size = scale(factor, shorter.terms()[i], row);
    size = add({total, size}, {row, row_size}, 1, next);
    std::swap(total, next);
  }
  result.size_ = compress(total, size);
  std::copy_n(total, result.size_, result.make_room(result.size_));
  return result;
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
