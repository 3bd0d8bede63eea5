#pragma once
// Facets that are there more than once.

#include "geom/repair/places.h"

namespace geom {

/// Facets with the same three vertices, however turned: all but the first are removed. Returns how many. O(F
/// log F).
std::size_t drop_repeated(Table<FacetId, TriMesh::Facet>& facets);

/// The wall between two bodies that were welded at a common face: facets, joined by edges, that are
/// there twice, once each way, with two other facets (or four, ...) at each edge of its rim. Both copies are
/// removed: the bodies become one. (A facet doubled on a surface has one other facet at its edges.) Returns
/// how many facets are gone. O(F log F).
std::size_t drop_walls(Table<FacetId, TriMesh::Facet>& facets);

/// Parts (facets joined by edges) of which each facet lies at the places of a facet of an earlier part,
/// however turned, are removed: a body doubled onto itself, a single facet of a soup. Returns the number of
/// facets. O(F log F).
std::size_t drop_doubled(const Places& places, Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
