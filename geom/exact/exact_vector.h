#pragma once
// Vectors of exact numbers.

#include "geom/exact/expansion.h"
#include "geom/vec.h"

namespace geom {

struct ExactVec3 {
  Expansion x, y, z;
};

/// a - b
inline ExactVec3 exact_difference(const Vec3& a, const Vec3& b) {
  return {Expansion::difference(a.x(), b.x()), Expansion::difference(a.y(), b.y()),
          Expansion::difference(a.z(), b.z())};
}
inline ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Expansion dot(const ExactVec3& a, const ExactVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// a b - c d
inline Expansion exact_minor(const Expansion& a, const Expansion& b, const Expansion& c, const Expansion& d) {
  return a * b - c * d;
}

}  // namespace geom
