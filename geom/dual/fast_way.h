#pragma once
// The fast way of a move: on a sheet of the surface, a removal or an insertion is that of the plane (paper,
// section 3.2), with a walk over facets where the plane has a formula.
//
//        r4 ____ r3             The star of x is a cycle of circles, and the sites around it are the rim.
//         /\    /\              Without x the hole is filled by triangles of the rim. They are guessed in the
//       /___\ x/___\  r2        plane of the rim, and for each the circle is found where the axis of the
//      r5   /\  /\   /          three sites meets the surface. x comes to a center: circles that it beats go,
//        \/____\/___/           reached from one another, and a new star is made.
//        r0      r1
//
// The guess is proven for the hole, and then for the new cell: where the surface is a sheet of small slope by
// looking at the sites alone (chart.h), else by tracing the cells over the facets that they meet (flood.h),
// where sites beyond the rim are tested at all corners found. A second component is excluded by the shape of
// the surface (sheets.h). The cells of the others are then right, too: they change in the hole and in the new
// cell only.
//
// What no tracing from circles would see are cells that no circle leads to, or that have several borders. A
// site is called regular if its cell is known to be connected, with one border, a closed curve through all of
// its circles. Only regular sites are removed in the fast way. Why regular sites stay so: the rim's sites are
// distinct, so each wins a part of the hole along one arc, or loses a part of its cell along one arc.
//
//   - Winning: the parts hang together with their cells, as the dual of the hole is a triangulated polygon.
//   - Losing: were the rest of a cell in two pieces, each would border the new cell, in an arc of its own.
//     The part that is lost of its border lies between the two circles at the ends of the arc: one interval,
//     so what is left closes to one curve.
//   - That all circles which the new site beats are reached: all edges of the diagram that cross the border
//     of the new cell end at its circles, and are counted (as many as the rim has sites). A circle inside
//     that is not reached would belong to cells surrounded by another one; that one then had two borders,
//     with circles on each: it is irregular, and the circles of irregular sites that may lose something are
//     looked at one by one. (If the surrounded cell is that of a single site there is no circle between the
//     two. That site has none on this border: irregular as well, and if it has no circle at all the general
//     way is taken, which finds out whether it is hidden.)
//
// False, from any of these, means: not certain, nothing is done.

#include <array>
#include <span>
#include <vector>

#include "geom/dual/chart.h"
#include "geom/dual/edge_trace.h"
#include "geom/dual/flood.h"
#include "geom/dual/losses.h"
#include "geom/dual/sheets.h"
#include "geom/dual/state.h"
#include "geom/dual/strangers.h"

namespace geom {

class FastWay {
 public:
  explicit FastWay(DualState& state);

  /// Plans the removal of p, which changes nothing.
  bool plan(SiteId p);
  /// Of the plan: the circles that the hole would have, without `beyond`; the rim, whose sites all win
  /// something; bounds of the power in the cell of p, and in the hole without p.
  std::span<const EmptyCircle> circles() const { return circles_; }
  std::span<const SiteId> rim() const { return rim_; }
  double reach() const { return reach_; }
  double max_radius2() const { return max_radius2_; }
  /// Makes these bounds the least, if that can be done.
  bool make_plan_exact();
  /// Ends the plan: p stays.
  void cancel();
  /// Carries the planned removal out. circles_created: in the order of circles().
  void remove(DualChange& change);
  /// p, as planned, to the center of that circle, if its link stays what it is.
  bool move_in_place(std::size_t circle, const WeightedPoint3& point, DualChange& change);

  /// p, which is out, to the center of an empty circle.
  bool insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at, DualChange& change);

  /// Finds out whether p is regular, and what the power in its cell is at most.
  void certify(SiteId p);

 private:
  static constexpr int most = Frame::most - 2;  ///< sites on a rim

  /// A triangle of the hole: sites by their places on the rim, counterclockwise.
  struct Triangle {
    std::array<int, 3> corners;
    std::array<int, 3>
        beyond;  ///< opposite to each: a triangle of the hole, or -1 - the edge of the rim from that place on
    FacetId facet;
    RoundedPoint point;
    Frame::Values values;  ///< there
  };
  /// A corner of the new cell, between rim sites j and j + 1.
  struct StarCorner {
    FacetId facet;
    RoundedPoint point;
  };

  bool open_star(SiteId p);
  bool guess_triangles();
  int apex(int first, int last) const;
  bool find_circle(Triangle& triangle, FacetId start);
  bool flip_until_empty();
  void flip(int i, int e, int j, int f);
  FacetId walk(int a, int b, int c, FacetId start);
  bool flatten_rim();
  bool chart_star();
  void chart_sites(const Sheet& sheet);
  bool prove_hole();
  double with_tolerance(double distance2) const;
  bool bound_hole();
  void raise_by_hole();
  struct Edge {
    int left, right;   ///< sites of the frame
    FacetId from, to;  ///< of its ends
    Vec3 start, end;   ///< from the frame's origin
  };
  double farthest2(const Edge& edge, double enough) const;
  bool trace_hole();
  bool no_stranger_in_hole();
  bool is_simple_with_strangers(double radius);
  bool prove_new_cell(FacetId home, double least_distance, std::span<const CircleId> reached);
  void find_far_rivals(double distance);
  double distance_to_search(double near, std::span<const CircleId> reached);
  bool find_star_corners();
  double power_bound_at_corners() const;
  void raise_reaches(const WeightedPoint3& old, double reach_before);
  bool chart_around(double distance);
  bool enclose_on_sheet(double distance);
  bool trace_cell(FacetId home);
  bool no_stranger_in_cell(double radius);
  bool is_regular(SiteId p);
  bool may_beat_unreached(std::span<const CircleId> reached);
  bool has_one_component(double distance);
  bool owns_nothing_of(FacetId t);
  bool keep_part(const Vec3& d, double c, double size);
  void lower_reach(SiteId r);
  bool find_conflict(CircleId first);
  EmptyCircle circle_of(const std::array<SiteId, 3>& counterclockwise, FacetId facet,
                        const RoundedPoint& point) const;
  int next(int i) const { return i + 1 == size() ? 0 : i + 1; }
  int previous(int i) const { return i == 0 ? size() - 1 : i - 1; }
  int size() const { return static_cast<int>(rim_.size()); }

  DualState& state_;
  Frame frame_;
  Chart chart_;
  Flood flood_;
  Sheets sheets_;
  Losses losses_;
  Strangers strangers_;
  Sheet sheet_;                 ///< of the chart
  bool on_sheet_ = false;       ///< the chart is simple, and what is proven is proven there
  bool hole_on_sheet_ = false;  ///< that of the plan was proven there

  SiteId p_;
  WeightedPoint3 old_;           ///< p_ as its circles have it
  int self_ = Frame::none;       ///< the number of p_ in the frame; in the chart it comes after the rim
  std::vector<SiteId> rim_;      ///< counterclockwise
  std::vector<CircleId> star_;   ///< of p and places j, j + 1 of the rim
  std::vector<CircleId> outer_;  ///< beyond them
  std::vector<double> x_, y_;    ///< the rim in its plane, from p
  std::vector<Triangle> triangles_;
  std::vector<EmptyCircle> circles_;
  double reach_ = 0, max_radius2_ = 0;
  double range_ = 0;                 ///< who owns something of the hole is that near to p_
  std::vector<StarCorner> corners_;  ///< of a new cell
  double cell_reach_ = 0;
  double kept_radius_ = 0;   ///< strangers are kept for a ball of that radius
  std::vector<double> arc_;  ///< bounds of the power on the edges of p_'s new cell
  double cell_power_ = 0;    ///< no location of a second component has more
  std::vector<CircleId> conflict_;
  std::vector<FacetId> starts_;
  struct HoleCorner {
    Vec3 place;
    double power, tolerance;
  };
  std::vector<HoleCorner> hole_corners_;
  // Workspaces.
  std::vector<Vec3> part_, clipped_;
  std::vector<SiteId> others_, suspects_;
  struct FarRival {
    double distance;  ///< from p_: it loses nothing farther away
    SiteId site;
  };
  std::vector<FarRival> far_rivals_;
  std::vector<FacetId> facets_;
  std::vector<Sheets::Neighbour> link_;
};

}  // namespace geom
