#pragma once
// Numbers of twice the precision of a double, for filters between doubles and exact arithmetic.

#include <cmath>
#include <type_traits>

namespace geom {

/// head + tail, |tail| <= ulp(head) / 2. As long as nothing over- or underflows a sum, a difference and a
/// product have relative errors below 4 u^2, 4 u^2 and 6 u^2, u = 2^-53 (Joldes, Muller, Popescu: Tight and
/// rigorous error bounds for basic building blocks of double-word arithmetic, 2017: AccurateDWPlusDW,
/// DWTimesDW1).
struct DoubleDouble {
  double head = 0, tail = 0;

  DoubleDouble() = default;
  DoubleDouble(double x) : head(x) {}  // NOLINT: as implicit as from float to double
  DoubleDouble(double high, double low) : head(high), tail(low) {}

  static DoubleDouble sum(double a, double b) {
    const double s = a + b, b_part = s - a, a_part = s - b_part;
    return {s, (a - a_part) + (b - b_part)};
  }
  /// Requires |a| >= |b| or a = 0.
  static DoubleDouble ordered_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  /// Dekker's: the products of the 26-bit halves are exact.
  static DoubleDouble product(double a, double b) {
    const double p = a * b;
#ifdef FP_FAST_FMA
    return {p, std::fma(a, b, -p)};
#else
    const double as = 0x8000001p0 * a, ah = as - (as - a), al = a - ah;
    const double bs = 0x8000001p0 * b, bh = bs - (bs - b), bl = b - bh;
    return {p, al * bl - (((p - ah * bh) - al * bh) - ah * bl)};
#endif
  }

  DoubleDouble operator-() const { return {-head, -tail}; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = sum(a.head, b.head), low = sum(a.tail, b.tail);
    const DoubleDouble carried = ordered_sum(high.head, high.tail + low.head);
    return ordered_sum(carried.head, low.tail + carried.tail);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = product(a.head, b.head);
    return ordered_sum(p.head, p.tail + (a.head * b.tail + a.tail * b.head));
  }
};

// What a filter needs of a number type, double or DoubleDouble: a difference of doubles, a rounded value, a
// bound u of the relative error of one operation.
inline void subtract(double a, double b, double& out) { out = a - b; }
inline void subtract(double a, double b, DoubleDouble& out) { out = DoubleDouble::sum(a, -b); }
inline double rounded(double x) { return x; }
inline double rounded(const DoubleDouble& x) { return x.head; }
template <class Real>
constexpr double unit_of = std::is_same_v<Real, double> ? 0x1p-53 : 0x1p-103;

}  // namespace geom
