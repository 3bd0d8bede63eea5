#pragma once
// What a remesh has left out: a tip that is farther from it than samples are from each other. Farthest points
// are corners inside of facets (the paper's type C), and a tip that is thinner than the spacing has none.

#include <span>

#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_sample.h"

namespace fpo {

struct FarPart {
  double of_wanted = 0;  ///< the distance in the length that is wanted there; 0: nothing is farther than one
  double distance = 0;
  geom::Vec3 at{0, 0, 0};  ///< a vertex of the surface
};

/// The vertex of the surface that is farthest from the remesh, if it is farther than the length wanted there
/// (`wanted`, of each vertex). Vertex i of the remesh is sample i, in a facet of the surface. Nothing of a
/// mesh without facets. Looked for at those vertices alone that are as far from a sample with triangles, the
/// one from which a walk over the facets from all of them at once comes. O(F), and a closest point for each
/// of these.
FarPart far_part(const geom::TriMesh& surface, const VertexField& wanted, const geom::TriMesh& remesh,
                 std::span<const SurfaceSample> samples);

}  // namespace fpo
