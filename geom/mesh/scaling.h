#pragma once
// How any surface comes into the range in which the predicates are exact (expansion.h): it is scaled by a
// power of two, so that its largest coordinate lies in [1/2, 1), and its coordinates are snapped to multiples
// of 2^-160. That moves a vertex by at most 2^-160 of the largest coordinate and leaves alone every
// coordinate of more than 2^-107 of it; facets smaller than that degenerate. Nothing is refused for being
// fine.

#include <cmath>

#include "geom/mesh/trimesh.h"

namespace geom {

/// The unit of coordinates; weights have its square.
inline constexpr double coordinate_unit = 0x1p-160;

/// The nearest multiple of `unit`, a power of two; halfway to even. Values beyond 2^53 units are multiples
/// already. Never leaves an interval whose ends are multiples.
///
/// Between 2^52 and 2^53 units doubles are one unit apart: the sum is rounded to a multiple, and the
/// difference is exact. A zero comes out positive.
inline double snapped(double x, double unit) {
  if (!(std::abs(x) < 0x1p52 * unit)) return x;
  const double shift = std::copysign(0x1p52 * unit, x);
  return (x + shift) - shift + 0.0;
}
/// Every coordinate snapped to coordinate_unit.
inline Vec3 snapped(const Vec3& p) {
  return {snapped(p.x(), coordinate_unit), snapped(p.y(), coordinate_unit), snapped(p.z(), coordinate_unit)};
}

/// The power of two that brings the largest coordinate of the meshes together into [1/2, 1); 1 if all are 0.
/// Throws InputError unless that coordinate is between 2^-900 and 2^900: beyond, results could not be scaled
/// back without rounding.
double factor_to_unit_box(const TriMesh& mesh);
double factor_to_unit_box(const TriMesh& a, const TriMesh& b);

/// The mesh with all coordinates multiplied, exactly if the factor is a power of two and nothing underflows.
TriMesh scaled(const TriMesh& mesh, double factor);
/// The mesh with all coordinates multiplied, then snapped. Facets may degenerate.
TriMesh scaled_to_unit_box(const TriMesh& mesh, double factor);

}  // namespace geom
