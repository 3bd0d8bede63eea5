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
//     two. That site has none on this border: irregular as well. If it has no circle at all it loses all or
//     nothing, for it has nothing in the new cell. Unless it surely is the nearest to its own place still,
//     the general way is taken, which finds out whether it is hidden.)
//
// Where the surface has levels (levels.h) tracing takes four coordinates where it has three. By the shape of
// a sheet is proven only what has one level; other sites are taken as they are seen from there.
//
// False, from any of these, means: not certain, nothing is done.

#include <span>
#include <vector>

#include "geom/dual/cell_proof.h"
#include "geom/dual/hole.h"
#include "geom/dual/known_cell.h"
#include "geom/dual/surroundings.h"

namespace geom {

class FastWay {
 public:
  explicit FastWay(DualState& state) : state_(state), around_(state), hole_(around_), cell_(around_) {}

  /// Plans the removal of p, which changes nothing.
  bool plan(SiteId p);
  /// Of the plan: the circles that the hole would have, without `beyond`; the rim, whose sites all win
  /// something; bounds of the power in the cell of p, and in the hole without p.
  std::span<const EmptyCircle> circles() const { return hole_.circles(); }
  std::span<const SiteId> rim() const { return around_.rim.sites(); }
  double reach() const { return hole_.reach(); }
  double max_radius2() const { return hole_.max_radius2(); }
  /// Makes these bounds the least, if that can be done.
  bool make_plan_exact() { return hole_.make_exact(); }
  /// Ends the plan: p stays.
  void cancel() { hole_.cancel(); }
  /// Carries the planned removal out. circles_created: in the order of circles().
  void remove(DualChange& change);
  /// p, as planned, to the center of that circle, if its link stays what it is. Not with another weight while
  /// there are leeways, which that ends: then p is removed and inserted.
  bool move_in_place(std::size_t circle, const WeightedPoint3& point, DualChange& change);

  /// Was the last such move proven with leeway?
  bool had_leeway() const { return had_leeway_; }

  /// p, which is out, to the center of an empty circle.
  bool insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId first, DualChange& change);

  /// Finds out whether p is regular, and what the power in its cell is at most.
  void certify(SiteId p);
  /// Before that is done to so many.
  void reserve(std::size_t num_sites) { around_.sheets.reserve(num_sites); }
  void shrink() { around_.sheets.forget(); }
  /// The same, of a cell that is known from elsewhere; what is known of one.
  void certify(SiteId p, const KnownCell& known);
  KnownCell known(SiteId p) const;

 private:
  bool prove_in_place(FacetId home, const WeightedPoint3& old);
  void raise_reaches(const WeightedPoint3& old);
  void erase_inside(DualChange& change);
  void fill_hole(DualChange& change);
  void make_star(DualChange& change);
  void name_rim(DualChange& change) const;
  void lower_reach(SiteId r);

  DualState& state_;
  Surroundings around_;
  Hole hole_;
  CellProof cell_;
  bool had_leeway_ = false;
  struct HoleCorner {
    SurfacePoint place;
    double power;
  };
  std::vector<HoleCorner> hole_corners_;  // workspace
};

}  // namespace geom
