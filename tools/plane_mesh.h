#pragma once
// The triangulation of samples on a flat torus as a mesh.

#include "fpo/plane/plane_domain.h"
#include "geom/mesh/trimesh.h"

namespace tools {

/// One period, flat at z = 0: vertex i is sample i; triangles over the border of the period have copies of
/// their other corners beyond it, after the samples, so that the mesh can be laid side by side with itself.
/// Every triangle is there once, counterclockwise. Hidden samples have none. O(n log n).
geom::TriMesh mesh_of(const fpo::PlaneDomain& domain);

}  // namespace tools
