#pragma once
// How any surface comes into the range in which the predicates are exact (expansion.h): it is scaled by a
// power of two, so that its largest coordinate lies in [1/2, 1), and its coordinates are snapped to multiples
// of 2^-160. That moves a vertex by at most 2^-160 of the largest coordinate and leaves alone every
// coordinate of more than 2^-107 of it; facets smaller than that degenerate. Nothing is refused for being
// fine.

#include "geom/mesh/trimesh.h"

namespace geom {

/// The unit of coordinates; weights have its square.
inline constexpr double coordinate_unit = 0x1p-160;

/// The nearest multiple of `unit`, a power of two; halfway to even. Values beyond 2^53 units are multiples
/// already. Never leaves an interval whose ends are multiples.
double snapped(double x, double unit);
/// Every coordinate snapped to coordinate_unit.
Vec3 snapped(const Vec3& p);

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
