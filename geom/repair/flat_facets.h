#pragma once
// Facets without area.

#include "geom/repair/places.h"

namespace geom {

/// Whether three points lie on one line, exactly for coordinates that are multiples of 2^-160 and at most 1.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Removes the facets of which two corners share a place. Returns how many.
std::size_t drop_collapsed(const Places& places, Table<FacetId, TriMesh::Facet>& facets);

/// What became of facets whose corners lie on one line.
struct Flattening {
  std::size_t dropped = 0;  ///< their longest edge was a border, or had more than two facets
  std::size_t flipped = 0;  ///< with the facet across their longest edge: the surface is the same, to the bit
  std::size_t left = 0;     ///< neither was possible
};

/// Mends facets whose corners lie on one line; no two may share a place. `vertices`: in the range of
/// collinear(). O(F log F) a pass; a pass is needed for each facet without area next to another.
Flattening mend_flat(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets);

/// Removes the facets that are marked; the others keep their order.
void drop_marked(const Table<FacetId, char>& marked, Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
