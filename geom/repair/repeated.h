#pragma once
// Facets that are there more than once.

#include "geom/repair/places.h"

namespace geom {

/// Facets with the same three vertices, however turned: all but the first are removed. Returns how many. O(F
/// log F).
std::size_t drop_repeated(Table<FacetId, TriMesh::Facet>& facets);

/// Parts (facets joined by edges) of which each facet lies at the places of a facet of an earlier part,
/// however turned, are removed: a body doubled onto itself, a single facet of a soup. Returns the number of
/// facets. O(F log F).
std::size_t drop_doubled(const Places& places, Table<FacetId, TriMesh::Facet>& facets);

}  // namespace geom
