#pragma once
// The restricted power diagram of a whole surface, facet by facet, on several threads (paper, section 4.2).

#include <functional>
#include <span>

#include "geom/power/facet_cells.h"

namespace geom {

/// The part of a cell on a facet.
struct FacetPiece {
  SiteId owner;
  std::span<const PolygonCorner> corners;  ///< from the edge of smallest label on
};

/// Calls visit(facet, pieces) for each of these facets in turn, on the calling thread; threads only divide.
/// Their number does not matter. `search` must hold all sites, and answer from several threads: a SiteTree.
/// Best along a curve (facets_along_curve()). Expected cost: the facets and the pieces, times the logarithm
/// of the number of sites.
struct DividedSurface {
  const TriMesh& mesh;
  const Clipper::Sites& sites;
  const Clipper& clipper;
  const NeighbourOracle& search;
  using Visit = std::function<void(FacetId, std::span<const FacetPiece>)>;
  void for_each(std::span<const FacetId> facets, int threads, const Visit& visit) const;
};

}  // namespace geom
