#pragma once
// Points all over a surface, dense enough to stand for it: what the local feature size is computed from
// (section 3.2 asks for it; Amenta & Bern, Surface reconstruction by Voronoi filtering, 1999, for a dense
// sample only).

#include <cstdint>
#include <vector>

#include "geom/mesh/trimesh.h"

namespace fpo {

/// A location on the surface.
struct CoverPoint {
  geom::Vec3 position;
  geom::Vec3 normal;  ///< unit, of the facets around weighted by area; 0 if they have no area or cancel out
  double facet_edge;  ///< longest edge of the facets around
};

/// All vertices that a facet names, and where edges are longer than `spacing` points on edges and facets,
/// such that every location of the surface has a point within `spacing`. Extra points lie on a triangular
/// lattice, a little off, lest many of them be on one sphere. spacing 0: the vertices alone; their gap is the
/// longest edge there. Deterministic, and scaling mesh and spacing by the same power of two scales the points
/// exactly. O(F + points). Throws InputError if the spacing is negative or not finite, or asks for more than
/// 20 million points.
std::vector<CoverPoint> surface_cover(const geom::TriMesh& mesh, double spacing, std::uint64_t seed);

/// About how many points that would be: an estimate, rather too large. Requires spacing > 0. O(F).
double cover_size(const geom::TriMesh& mesh, double spacing);

}  // namespace fpo
