#pragma once
// Where the axis of three sites meets the surface: the corner of their cells, found by a walk over facets.
//
//          /|\             On a facet the differences F, G of the powers of two sites to that of the third
//         / | \            are affine, so at its corners l = F x G are the barycentric coordinates, up to
//        / t|  \           scale, of where both vanish (construct.h). If none is negative the axis meets the
//       /___|___\          facet. Else the walk goes on across the edge opposite the corner of least l, at
//                          whose ends F and G are known.
//
// The l are rounded and off by a bound: if all are more than that, the axis surely meets the inside of the
// facet, and the sign of their sum tells on which side of the surface the sites turn counterclockwise. Which
// way the walk goes where l is uncertain does not matter: what it finds is proven by who asked (fast_way.h).

#include <array>

#include "geom/power/clip.h"

namespace geom {

struct AxisPlace {
  FacetId facet;                ///< none: not certain, or too far
  RoundedPoint point;           ///< Clipper::meeting() there
  std::array<SiteId, 3> sites;  ///< ascending
  bool clockwise = false;       ///< ascending they turn clockwise, seen from outside
};

/// The sites turn counterclockwise there, seen from outside. Cost: the facets on the way.
AxisPlace walk_to_axis(const TriMesh& mesh, const Clipper& clipper, const std::array<SiteId, 3>& sites,
                       FacetId start);

}  // namespace geom
