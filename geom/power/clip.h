#pragma once
// Clips facets to power cells: the polygons of facet_polygon.h.

#include <span>
#include <vector>

#include "geom/power/cell_corners.h"

namespace geom {

/// Clips facets of one mesh by bisectors of one set of sites. Clipping needs room for its work, so each
/// thread has its own.
class Clipper : public CellCorners {
 public:
  using CellCorners::CellCorners;

  /// What can be said of the whole facet from the ball about it (facet_balls.h).
  Clip compare_on_facet(FacetId facet, const Bisector& b) const { return facets().compare(facet, b); }
  FacetBalls::Lead lead_on_facet(FacetId facet, const Bisector& b) const { return facets().lead(facet, b); }
  bool comes_near(FacetId facet, const Vec3& x, double distance) const {
    return facets().comes_near(facet, x, distance);
  }
  const Vec3& middle(FacetId facet) const { return facets().middle(facet); }
  double radius(FacetId facet) const { return facets().radius(facet); }

  /// Which corners j takes: none, some, all. O(corners). Fills `beaten` where the answer is `cut`.
  Clip classify_corners(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                        const Bisector& b, std::vector<char>& beaten) const;
  /// The same, with a look at the whole facet first.
  Clip classify(FacetId facet, SiteId owner, std::span<const PolygonCorner> corners, SiteId j,
                const Bisector& b, std::vector<char>& beaten) const {
    const Clip whole = compare_on_facet(facet, b);
    return whole != Clip::cut ? whole : classify_corners(facet, owner, corners, j, b, beaten);
  }

  /// Takes away what j beats. The new edge is labelled j. O(corners).
  Clip clip(FacetPolygon& polygon, SiteId j, const Bisector& b);
  Clip clip(FacetPolygon& polygon, SiteId j) { return clip(polygon, j, bisector_of(polygon.owner, j)); }
  /// Takes away what j does not beat: what is left is on j's side of the bisector.
  Clip clip_beyond(FacetPolygon& polygon, SiteId j, const Bisector& b);
  /// clip() with the answer of classify() at hand.
  void cut(FacetPolygon& polygon, SiteId j, const Bisector& b, const std::vector<char>& beaten);

 private:
  std::vector<char> beaten_;            // workspace
  std::vector<PolygonCorner> scratch_;  // workspace
};

}  // namespace geom
