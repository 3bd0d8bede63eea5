#pragma once
// Vertices far out of their surface: outliers of a scan.

#include <vector>

#include "geom/mesh/trimesh.h"

namespace geom {

/// A vertex of 4 to 12 neighbours that are near each other and all far from it: the nearest is more than 8
/// times as far as half of them are, at most, from the median of their coordinates and from their other
/// neighbours. Tips of cones have more neighbours, rods and horns nearer ones, stretched bodies longer edges.
/// Where three more vertices are at the very same place, to which an exporter gave all that it had lost, 1.5
/// times is enough, and neighbours that are there do not count.
struct Spike {
  VertexId vertex;
  Vec3 base;  ///< that median
};

/// In ascending order. None if they were more than a twentieth of the vertices, for then it is a shape.
/// O(F log F).
std::vector<Spike> spikes(const Table<VertexId, Vec3>& vertices,
                          const Table<FacetId, TriMesh::Facet>& facets);

/// Moves spikes to their bases, again if there are others then, at most 4 times. Facets stay. How many moves.
/// Deterministic.
std::size_t flatten_spikes(Table<VertexId, Vec3>& vertices, const Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
