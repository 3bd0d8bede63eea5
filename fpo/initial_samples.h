#pragma once
// The initial point set on a surface (paper, section 4.2): random triangles with probability proportional to
// area, a uniform random point in each.

#include <cstdint>
#include <vector>

#include "geom/trimesh.h"

namespace fpo {

/// A location on the surface, rounded from facet coordinates.
struct SurfaceSample {
  geom::Vec3 position;
  geom::FacetId facet;
};

/// The location with barycentric coordinates (1 - u - v, u, v).
geom::Vec3 location_in_facet(const geom::TriMesh& mesh, geom::FacetId t, double u, double v);

/// Exactly n independent samples, uniform by area; a function of mesh, n and seed. O(F + n log F).
/// Throws InputError if n is 0 or absurd, or if the surface has no area.
std::vector<SurfaceSample> random_samples(const geom::TriMesh& mesh, std::size_t n, std::uint64_t seed);

}  // namespace fpo
