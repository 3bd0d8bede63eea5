#pragma once
// Corners of the diagram's polygons as empty circles, and circles as corners.

#include <array>
#include <span>

#include "geom/dual/axis_walk.h"
#include "geom/dual/empty_circles.h"
#include "geom/mesh/trimesh.h"
#include "geom/power/clip.h"

namespace geom {

/// Which corners of the diagram are registered as empty circles. Type C are the candidates for the farthest
/// point in the paper (section 4.1); power being convex on a fragment, the farthest point of the whole
/// surface can also be of type B (border, crease) or A (tip).
enum class CornerTypes { c_only, all };

class CornerCircles {
 public:
  /// Keeps a reference; its sites are those of the circles.
  CornerCircles(const Clipper& clipper, const TriMesh& mesh, const Clipper::Sites& sites, CornerTypes types);
  CornerTypes types() const { return types_; }

  struct Polygon {
    FacetId facet;
    SiteId owner;
    std::span<const PolygonCorner> corners;
  };
  /// A corner of a polygon of the diagram as a circle; none if another polygon registers it. Each C corner is
  /// seen from three cells: the one of smallest id registers it. A B corner is registered by the smaller id
  /// in the smaller facet, an A corner in the first facet of the vertex.
  bool find(const Polygon& polygon, std::size_t corner, EmptyCircle& out) const;
  /// The same whichever of its cells registers it; a B corner still in the smaller facet only.
  bool find_of_any(const Polygon& polygon, std::size_t corner, EmptyCircle& out) const;
  /// The circle of three sites, counterclockwise, at that place.
  EmptyCircle circle_of(const std::array<SiteId, 3>& sites, FacetId facet, const Vec3& place) const;
  /// The same where their axis meets the surface.
  EmptyCircle circle_at(const AxisPlace& meeting) const;
  /// A circle as a corner of the cell of its first site. `tolerance`: of its center.
  CellCorner corner_of(const EmptyCircle& circle, double tolerance) const;
  /// Center and radius2 of a circle in the facet that touches the site. The corner is rounded; a site may
  /// come to the center: not outside of the facet's box, hence the mesh's.
  struct Place {
    Vec3 center;
    double radius2;
  };
  Place place_of(const Vec3& corner, FacetId facet, SiteId site) const;

 private:
  void center(EmptyCircle& circle, const Vec3& corner) const {
    const Place place = place_of(corner, circle.facet, circle.sites[0]);
    circle.center = place.center;
    circle.radius2 = place.radius2;
  }

  const Clipper& clipper_;
  const TriMesh& mesh_;
  const Clipper::Sites& sites_;
  const CornerTypes types_;
  Table<VertexId, FacetId> first_facet_;  ///< CornerTypes::all only: where a vertex's circle is registered
};

}  // namespace geom
