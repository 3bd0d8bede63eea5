#pragma once
// A facet of the surface clipped to one power cell: a convex polygon whose edges are labelled, decided
// exactly.
//
//            k (site)             The polygon is known by its labels alone: each edge lies on an edge of
//          o---------o            the facet or on the bisector of the owner with a site. A corner is the
//         /   owner   \  j        meeting of two labels (paper, section 4.1):
//        o-------------o            type A  facet edge, facet edge   a vertex of the surface
//          facet edge               type B  facet edge, site         an edge of the surface and a bisector
//                                   type C  site, site               an edge of the power diagram
//
// Positions are rounded and carry their error bound; they serve as filter, never as the judge.

#include <span>
#include <vector>

#include "geom/ids.h"
#include "geom/power/construct.h"

namespace geom {

/// What an edge of a clipped facet lies on.
class EdgeLabel {
 public:
  constexpr EdgeLabel() = default;
  static constexpr EdgeLabel bisector(SiteId j) { return EdgeLabel(j.value); }
  static constexpr EdgeLabel facet_edge(int e) { return EdgeLabel(-1 - e); }
  constexpr bool is_site() const { return code_ >= 0; }
  constexpr SiteId site() const { return SiteId(code_); }
  constexpr int edge() const { return -1 - code_; }
  constexpr auto operator<=>(const EdgeLabel&) const = default;

 private:
  constexpr explicit EdgeLabel(std::int32_t code) : code_(code) {}
  std::int32_t code_ = 0;
};

/// A corner and the edge that starts there, counterclockwise.
struct PolygonCorner {
  RoundedPoint point;
  EdgeLabel edge;
};

/// The corners of a polygon of n corners are in a cycle.
inline std::size_t next_corner(std::size_t k, std::size_t n) { return k + 1 == n ? 0 : k + 1; }
inline std::size_t previous_corner(std::size_t k, std::size_t n) { return k == 0 ? n - 1 : k - 1; }

/// A clipped facet under work. No corners: empty.
struct FacetPolygon {
  FacetId facet;
  SiteId owner;
  std::vector<PolygonCorner> corners;

  EdgeLabel edge_before(std::size_t k) const { return corners[previous_corner(k, corners.size())].edge; }
};

/// A corner of the polygon of `owner` on a facet, by itself: between the edges `before` and `after`.
struct CellCorner {
  FacetId facet;
  SiteId owner;
  EdgeLabel before, after;
  RoundedPoint point;
};

inline CellCorner cell_corner(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners,
                              std::size_t k) {
  return {facet, owner, corners[previous_corner(k, corners.size())].edge, corners[k].edge, corners[k].point};
}

}  // namespace geom
