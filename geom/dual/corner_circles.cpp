#include "geom/dual/corner_circles.h"

#include <algorithm>

#include "geom/mesh/scaling.h"

namespace geom {

CornerCircles::CornerCircles(const Clipper& clipper, const TriMesh& mesh, const Clipper::Sites& sites,
                             CornerTypes types)
    : clipper_(clipper), mesh_(mesh), sites_(sites), types_(types) {
  if (types_ == CornerTypes::c_only) return;
  first_facet_.resize(mesh_.num_vertices());
  for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh_.facet(t))
      if (!first_facet_[v].valid()) first_facet_[v] = t;
}

bool CornerCircles::find(const Polygon& polygon, std::size_t corner, EmptyCircle& out) const {
  const EdgeLabel before = polygon.corners[previous_corner(corner, polygon.corners.size())].edge,
                  after = polygon.corners[corner].edge;
  if ((before.is_site() && before.site() < polygon.owner) ||
      (after.is_site() && after.site() < polygon.owner))
    return false;
  return find_of_any(polygon, corner, out);
}

bool CornerCircles::find_of_any(const Polygon& polygon, std::size_t corner, EmptyCircle& out) const {
  const EdgeLabel before = polygon.corners[previous_corner(corner, polygon.corners.size())].edge,
                  after = polygon.corners[corner].edge;
  out = EmptyCircle();
  out.facet = polygon.facet;
  out.sites[0] = polygon.owner;
  if (before.is_site() && after.is_site()) {
    out.sites = {polygon.owner, before.site(), after.site()};
    out.sort_counterclockwise();
  } else if (types_ == CornerTypes::c_only) {
    return false;
  } else if (before.is_site() || after.is_site()) {
    const EdgeLabel edge = before.is_site() ? after : before, site = before.is_site() ? before : after;
    const FacetId across = mesh_.across(polygon.facet, edge.edge());
    if (across.valid() && across < polygon.facet) return false;
    out.sites = {std::min(polygon.owner, site.site()), std::max(polygon.owner, site.site()), SiteId()};
    out.place = static_cast<std::int16_t>(1 + edge.edge());
  } else {
    const int i = after.edge();  // edges i - 1 and i meet in corner i
    if (first_facet_[mesh_.facet(polygon.facet)[static_cast<std::size_t>(i)]] != polygon.facet) return false;
    out.place = static_cast<std::int16_t>(4 + i);
  }
  center(out, polygon.corners[corner].point.position);
  return true;
}

EmptyCircle CornerCircles::circle_of(const std::array<SiteId, 3>& sites, FacetId facet,
                                     const Vec3& place) const {
  EmptyCircle circle;
  circle.facet = facet;
  circle.sites = sites;
  circle.sort_counterclockwise();
  center(circle, place);
  return circle;
}

EmptyCircle CornerCircles::circle_at(const AxisPlace& meeting) const {
  EmptyCircle circle;
  circle.facet = meeting.facet;
  circle.sites = meeting.sites;
  circle.clockwise = meeting.clockwise;
  center(circle, meeting.point.position);
  return circle;
}

CellCorner CornerCircles::corner_of(const EmptyCircle& circle, double tolerance) const {
  const auto edge = [](int e) { return EdgeLabel::facet_edge(e); };
  CellCorner corner{circle.facet, circle.sites[0], EdgeLabel(), EdgeLabel(), {circle.center, tolerance}};
  if (circle.is_triangle()) {
    corner.before = EdgeLabel::bisector(circle.sites[1]);
    corner.after = EdgeLabel::bisector(circle.sites[2]);
  } else if (circle.sites[1].valid()) {
    corner.before = edge(circle.place - 1);
    corner.after = EdgeLabel::bisector(circle.sites[1]);
  } else {
    corner.before = edge(circle.place == 4 ? 2 : circle.place - 5);
    corner.after = edge(circle.place - 4);
  }
  return corner;
}

CornerCircles::Place CornerCircles::place_of(const Vec3& corner, FacetId facet, SiteId site) const {
  const auto [v0, v1, v2] = mesh_.facet(facet);
  const Vec3 &q0 = mesh_.position(v0), &q1 = mesh_.position(v1), &q2 = mesh_.position(v2);
  const Vec3 least = q0.cwiseMin(q1).cwiseMin(q2), most = q0.cwiseMax(q1).cwiseMax(q2);
  Place place{snapped(corner.cwiseMax(least).cwiseMin(most)), 0};
  const double level = clipper_.levels().at(facet, place.center);
  place.radius2 = power(Location3(place.center, level), sites_[site]);
  return place;
}

}  // namespace geom
