#pragma once
// Where two surfaces are apart: the distance that hausdorff.h sums up, as a number of each facet.

#include "geom/mesh/trimesh.h"

namespace fpo {

/// For each facet of the mesh the largest distance found between it and the reference, in both directions:
/// from seven points of the facet (the middles of its edges, its own, and those halfway from there to its
/// corners) to the reference, and from those vertices and middles of edges and facets of the reference that
/// are nearest to the facet. None exceeds the Hausdorff distance; where the surfaces are far apart it is
/// nearly that. In the units of the coordinates. The result does not depend on the number of threads. Throws
/// geom::InputError if a mesh has no facet. Cost: seven closest points a facet of either.
geom::Table<geom::FacetId, double> facet_deviations(const geom::TriMesh& mesh, const geom::TriMesh& reference,
                                                    int threads = 1);

}  // namespace fpo
