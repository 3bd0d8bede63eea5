#pragma once
// An edge of the diagram followed over the facets: how far it comes from its sites.

#include "geom/mesh/trimesh.h"

namespace geom {

/// An edge between two corners of the diagram. Seen from outside, along it the one site is on the left.
struct TracedEdge {
  FacetId from, to;  ///< of its ends
  Vec3 start, end;

  struct Extent {
    double
        far2;  ///< a bound of the squared distance from the left site; infinite if a decision is not certain
    Vec3 twice_area;  ///< that the edge sweeps out, seen from there
  };
};
/// Cost: the facets on the way, of which there must not be very many.
TracedEdge::Extent extent_of_edge(const TriMesh& mesh, const WeightedPoint3& left,
                                  const WeightedPoint3& right, const TracedEdge& edge);

}  // namespace geom
