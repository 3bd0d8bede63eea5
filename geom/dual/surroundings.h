#pragma once
// What the fast way (fast_way.h) knows around a site that goes, comes or is looked at: the rim in a frame,
// the sheet of the surface there with its chart, the strangers beyond the rim, the facets that were traced.

#include "geom/dual/axis_walk.h"
#include "geom/dual/chart.h"
#include "geom/dual/edge_trace.h"
#include "geom/dual/flood.h"
#include "geom/dual/frame_vertices.h"
#include "geom/dual/rim.h"
#include "geom/dual/sheets.h"
#include "geom/dual/state.h"
#include "geom/dual/strangers.h"

namespace geom {

namespace margin {
constexpr double more = 1 + 1e-9;  ///< for the rounding of distances
constexpr double bend = 1.1;       ///< of an edge does not matter
constexpr double stretch = 1.05;   ///< beyond the ends of an edge is not worth a closer look
constexpr double ampler = 1.15;    ///< a cell than its corners
constexpr double widest = 1.35;    ///< in radii of a cell: the distance for which a sheet is made
}  // namespace margin

struct Surroundings {
  /// Keeps a reference.
  explicit Surroundings(DualState& whole);
  Surroundings(const Surroundings&) = delete;

  /// Nothing is known of the sheet, the strangers and the facets, and there is no leeway.
  void forget();
  /// Sees the rim from where p is; p itself has no number.
  void see_rim();
  /// Puts the rim and p into a chart.
  void chart_sites(const Sheet& found);
  /// The same on a sheet that covers that distance around p, if there is one; sets on_sheet.
  bool chart_around(double distance);
  /// The sheet about p that covers that distance: only where all sites of the frame have one level.
  const Sheet* sheet_around(double distance) {
    return frame.is_level() ? sheets.around(p, {site().position, site().level}, distance) : nullptr;
  }

  /// Have all sites of the frame, and that facet, or all that were traced, the level of its origin?
  bool is_level(FacetId t) const;
  bool is_flood_level() const;

  const WeightedPoint3& site() const { return state.sites[p]; }
  /// That of the rim.
  const WeightedPoint3& site(int j) const { return state.sites[rim[j]]; }
  /// A bound of the power, to that site, along an edge of its cell between these circles with slopes of at
  /// most `steepest` (chart.h). Infinite if a closer look is worth while.
  double power_along(const WeightedPoint3& own, const Vec3& from, const Vec3& to, double steepest) const;
  /// A location of that facet with its level; that of a circle.
  SurfacePoint on_surface(FacetId t, const RoundedPoint& point) const {
    const FacetLevels& levels = state.clipper.levels();
    return {point.position, levels.at(t, point.position), point.tolerance + levels.off(t, point.tolerance)};
  }
  SurfacePoint on_surface(const EmptyCircle& circle) const {
    return on_surface(circle.facet, {circle.center, 2 * state.clipper.most_tolerance()});
  }
  SurfacePoint on_surface(const Flood::Corner& corner) const {
    return {corner.at.y + frame.origin().position, corner.at.rise + frame.origin().level, corner.off};
  }
  /// The squared distance; of four coordinates a bound.
  double distance2(const SurfacePoint& z, const WeightedPoint3& to) const {
    const double in_space = (z.position - to.position).squaredNorm();
    if (!state.has_levels) return in_space;
    const double rise = std::abs(z.level - to.level) + z.off;
    return in_space + rise * rise;
  }
  double power_at(const SurfacePoint& z, const WeightedPoint3& of) const {
    return distance2(z, of) - of.weight;
  }
  /// A bound of the squared distance where circles may be off.
  double with_tolerance(double distance2) const {
    const double off = 2 * state.clipper.most_tolerance();
    return distance2 * (1 + 1e-6) + 1.1e6 * off * off;  // (a + b)^2 <= a^2 (1 + e) + b^2 (1 + 1 / e)
  }

  struct Edge {
    int left, right;   ///< sites of the frame
    FacetId from, to;  ///< of its ends
    Vec3 start, end;   ///< from the frame's origin
  };
  /// A bound, squared, of how far an edge of the diagram comes from one of its sites: by the chart, if that
  /// is enough, else from facet to facet.
  double farthest2(const Edge& edge, double enough) const;
  /// Have the strangers nothing beside edges of the chart at whose ends they are farther (chart.h), nor of
  /// what these surround: the cells of the first so many of the chart's sites from that one on? All that is
  /// spoken of is that near to the frame's origin.
  struct Division {
    std::span<const Chart::Edge> edges;
    int first, count;
  };
  bool leaves_strangers_out(const Division& division, double radius);
  // With leeway (leeway.h):
  /// A bound, squared, of how far an edge of p's cell, beside that one of the rim, comes from p: a closer one
  /// only if it is not near enough.
  double farthest2_with_leeway(int other, const TracedEdge& edge, double enough) const;
  /// Are the strangers that are kept farther from the point than its owner?
  bool are_kept_beyond(const SurfacePoint& point, const WeightedPoint3& owner) const;
  /// Has the cell of p one component, if it is that near to p? (sheets.h)
  bool has_one_component(double distance) const;
  /// So near to a place is all that is spoken of.
  double room_around(const Vec3& place) const {
    return leeway->radius - (place - leeway->origin).norm() * margin::more;
  }
  /// Where the axis of three sites meets the surface: one such place, found from there, or else from a circle
  /// inside the rim. Across folds the first walk may lose its way.
  AxisPlace meeting(const std::array<SiteId, 3>& sites, FacetId start) const {
    AxisPlace place = walk_to_axis(state.mesh, state.clipper, sites, start);
    if (!place.facet.valid()) place = meeting_from_inside(sites);
    return place;
  }

  AxisPlace meeting_from_inside(const std::array<SiteId, 3>& sites) const;

  DualState& state;
  SiteId p;
  Rim rim;
  Frame frame;
  FrameVertices vertices;  ///< seen in it
  int self = Frame::none;  ///< the number of p in the frame; in the chart it comes after the rim
  Sheets sheets;
  Sheet sheet;  ///< of the chart
  Chart chart;
  const Leeway* leeway = nullptr;   ///< if there is one, no chart is needed
  bool on_sheet = false;            ///< the chart is simple, and what is proven is proven there
  std::vector<Chart::Edge> spokes;  ///< in the chart: p and each of the rim
  Strangers strangers;
  Flood flood;
};

}  // namespace geom
