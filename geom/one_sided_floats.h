#pragma once
// Doubles in single precision, rounded to one side: bounds in half the memory.

#include <bit>
#include <cstdint>

namespace geom {

/// The least float that is not less: infinite beyond the largest one.
inline float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  if (!(f < x)) return f;
  const auto bits = std::bit_cast<std::int32_t>(f);
  return std::bit_cast<float>(bits < 0 ? bits - 1 : bits + 1);  // the next one
}
/// The largest float that is not more.
inline float rounded_down(double x) { return -rounded_up(-x); }

}  // namespace geom
