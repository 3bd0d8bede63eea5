#pragma once
// Which vertices lie at one place.

#include "geom/mesh/trimesh.h"

namespace geom {

using Places = Table<VertexId, VertexId>;

/// For each vertex the least id among those with equal coordinates (-0 equals 0). O(V log V).
Places exact_places(const Table<VertexId, Vec3>& vertices);

/// Likewise, but border vertices (those of an edge with one facet) whose distance is at most `tolerance`
/// share a place too, nearest pairs first, unless a facet would then have two corners at one place. O(V log
/// V) unless the tolerance reaches over many vertices; throws InputError if there are more than `most_pairs`
/// so near.
Places near_places(const Table<VertexId, Vec3>& vertices, const Table<FacetId, TriMesh::Facet>& facets,
                   double tolerance, std::size_t most_pairs = 30'000'000);

}  // namespace geom
