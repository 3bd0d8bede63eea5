#pragma once
// A location on the input surface.

#include "geom/mesh/scaling.h"
#include "geom/mesh/trimesh.h"

namespace fpo {

/// A location in a facet, rounded from facet coordinates.
struct SurfaceSample {
  geom::Vec3 position;
  geom::FacetId facet;
};

/// q0 + u (q1 - q0) + v (q2 - q0), kept inside the facet's box against rounding and snapped to the exact
/// range (geom/mesh/scaling.h).
inline SurfaceSample location_in_facet(const geom::TriMesh& mesh, geom::FacetId t, double u, double v) {
  const geom::Vec3 &q0 = mesh.corner(t, 0), &q1 = mesh.corner(t, 1), &q2 = mesh.corner(t, 2);
  const geom::Vec3 x = q0 + u * (q1 - q0) + v * (q2 - q0);
  return {geom::snapped(x.cwiseMax(q0.cwiseMin(q1).cwiseMin(q2)).cwiseMin(q0.cwiseMax(q1).cwiseMax(q2))), t};
}

}  // namespace fpo
