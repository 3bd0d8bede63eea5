#pragma once
// The distance between two surfaces: the paper's d_H (section 6), with a proven bound, and the mean distance.

#include "geom/mesh/trimesh.h"

namespace fpo {

/// Two-sided distances between two surfaces, in the units of their coordinates.
struct SurfaceDistance {
  double max = 0;  ///< Hausdorff distance: the largest distance found of a point of one to the other surface
  double max_bound = 0;  ///< no point of either is farther (up to rounding of the order 1e-15 diagonals)
  double rms = 0;        ///< root mean square over a surface's area; the larger one of the two directions
};

/// Compares the surfaces and not only samples of them: max_bound exceeds max by at most 0.1% or, if that is
/// more, 1e-6 of the reference's diagonal (unless 300,000 triangles, besides two a facet, do not suffice for
/// that: then max_bound is farther off, but still a bound). The mean is by a quadrature of degree 2, with
/// about 100,000 points a surface and at least three a facet; a surface without area has all facets equal
/// weight. The result does not depend on the number of threads. Throws geom::InputError if a mesh has no
/// facet. Cost: some queries of closest points a facet, more where the distance is near its maximum.
SurfaceDistance surface_distance(const geom::TriMesh& mesh, const geom::TriMesh& reference, int threads = 1);

}  // namespace fpo
