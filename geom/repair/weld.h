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
/// Crowds::leave no edge comes to have more than two facets that had not. `vertices`: if given, pairs whose
/// facets lie on one another, within a degree, are left: those are copies of one sheet, or its two sides.
/// O(F log F).
Welding weld_borders(const Places& places, Table<FacetId, TriMesh::Facet>& facets, Crowds crowds,
                     const Table<VertexId, Vec3>* vertices = nullptr);

/// Welds borders that coincide but for rounding: within 2^-22 diagonals, four steps of single precision where
/// coordinates are up to a diagonal, but at most a hundredth of the median border edge (a stray facet
/// far away makes the diagonal long). Nothing unless as many pairs are within sixteen times that: what keeps
/// others apart is no rounding, or a part would be welded in some places only. Nor where facets lie on one
/// another, or too many vertices are that near. O(F log F).
Welding weld_rounded(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets);

/// The distance within which borders are welded if nobody names one: 1e-6 diagonals, but at most a hundredth
/// of the median border edge. Where more than a tenth of the edges are borders even so, as in a soup whose
/// corners differ by more, it is the power of ten times that which halves them last and leaves at most half
/// of the pieces, below a tenth of the median border edge: slits in one piece are no soup. O(F log F).
double usual_tolerance(const Table<VertexId, Vec3>& vertices, const Table<FacetId, TriMesh::Facet>& facets);

/// A larger one that leaves at most half of the borders where the usual one leaves more, below a fifth of the
/// median border edge: 1, 2 or 5 times a power of ten of `unit`; 0 if there is none. O(F log F).
double wider_tolerance(const Table<VertexId, Vec3>& vertices, const Table<FacetId, TriMesh::Facet>& facets,
                       double unit);

}  // namespace geom
