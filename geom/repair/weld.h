#pragma once
// Border edges that lie at one place become one edge.

#include "geom/repair/places.h"

namespace geom {

struct Welding {
  std::size_t pairs = 0;    ///< of border edges that have become one edge
  std::size_t crowded = 0;  ///< edges left alone, for more than two share their ends' places
};

/// What to do where more than two border edges lie at one place: leave them, or make them one edge that is no
/// manifold (split.h decides then who belongs to whom).
enum class Crowds { leave, weld };

/// Facets are led to the vertex of least id among those that are welded; no vertex is removed or moved. Only
/// ends of border edges that pair up are welded, so closed sheets that touch stay apart, and with
/// Crowds::leave no edge comes to have more than two facets that had not. O(F log F).
Welding weld_borders(const Places& places, Table<FacetId, TriMesh::Facet>& facets, Crowds crowds);

}  // namespace geom
