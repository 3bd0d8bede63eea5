#pragma once
// Dynamic regular triangulation of weighted points on the flat torus (paper, section 3.1), the dual of the
// periodic power diagram.

#include <span>
#include <vector>

#include "geom/exact/predicates.h"
#include "geom/ids.h"
#include "geom/regular/flat_torus.h"
#include "geom/regular/insertion2.h"
#include "geom/regular/regular_change.h"
#include "geom/regular/removal2.h"
#include "geom/regular/triangulation2.h"
#include "geom/vec.h"

namespace geom {

/// One triangle per orbit of the periodic triangulation, no copies of sites. Invariant: every edge is shorter
/// than half a period in each coordinate, so the place of one corner relative to another is the shortest
/// periodic difference and no offsets are stored. A change that would break this (too few or too clustered
/// sites) throws InputError before anything is modified.
///
/// All decisions are exact (predicates.h; the rank of a site is its id), so the triangulation is a function
/// of periods, sites, weights and ids alone. Each triangle keeps its dual power vertex: the center of the
/// circle orthogonal to its corners. Steady state allocates nothing. Not thread-safe, reading included.
class Regular2 {
 public:
  using Triangle = Triangulation2::Triangle;  ///< corners counterclockwise
  /// The id of a destroyed triangle may be in use again, hence in both lists.
  using Change = RegularChange;
  struct Nearest {
    SiteId id;
    double power;  ///< |x - p_id|^2 - w_id
  };

  /// The triangulation of points with ids 0, 1, ...; positions are moved to the nearest grid point of the
  /// torus. O(n log n). Throws InputError for bad periods (FlatTorus), positions or weights that are not
  /// finite or huge, or points that leave a gap of about half a period (always if fewer than four).
  Regular2(const Vec2& period, std::span<const WeightedPoint2> points);

  /// Inserts a site under an id not in use, snapped to the grid. `hint`: a triangle nearby, best one whose
  /// circle the site conflicts with; none for a walk from the last change. Expected O(1) with a good hint.
  Change insert(SiteId id, const WeightedPoint2& point, SimplexId hint = SimplexId());
  /// Removes a site, visible or hidden. O(k^2) for k neighbours; expected O(1).
  Change remove(SiteId id);

  const FlatTorus& torus() const { return triangulation_.torus; }
  bool contains(SiteId id) const { return triangulation_.contains(id); }
  bool is_hidden(SiteId id) const { return triangulation_.is_hidden(id); }
  WeightedPoint2 point(SiteId id) const {
    const Triangulation2::Site& s = triangulation_.sites[id];
    return {{s.x, s.y}, s.weight};
  }
  /// The shortest vector from a to b: the edge, if they are joined.
  Vec2 difference(SiteId a, SiteId b) const { return triangulation_.difference(a, b); }
  /// The site other than `id` with the least power at the position of `id`. Expected O(1).
  Nearest nearest_other(SiteId id) const;
  /// The sites joined to `id` by an edge, counterclockwise. Empty for a hidden site.
  void link(SiteId id, std::vector<SiteId>& out) const;
  /// Calls visit(triangle, index of the corner `id` in it), counterclockwise. `id` must be visible.
  template <class Visit>
  void visit_star(SiteId id, Visit&& visit) const {
    triangulation_.visit_star(id, visit);
  }

  /// Ids of triangles are below.
  std::size_t simplex_capacity() const { return triangulation_.simplices.size(); }
  bool is_live(SimplexId t) const { return triangulation_.is_live(t); }
  const Triangle& corners(SimplexId t) const { return triangulation_.simplices[t].corner; }
  /// The dual power vertex, coordinates in [0, period], rounded, and its power to the corners. radius2 is
  /// computed from the corner of smallest id, so its bits are a function of the triangle alone.
  Vec2 center(SimplexId t) const {
    const PowerCircle& circle = triangulation_.simplices[t].circle;
    return {circle.center_x, circle.center_y};
  }
  double radius2(SimplexId t) const { return triangulation_.simplices[t].circle.radius2; }
  /// An order of live triangles by their corners (ids), whatever their ids.
  bool simplex_before(SimplexId a, SimplexId b) const;
  std::vector<Triangle> triangles() const;  ///< smallest corner first, in no particular order

  /// What a hint to the memory loads, for a site that will be removed soon: the site; a triangle at it; that
  /// one's neighbours and corners; the star. Each needs what the one before has loaded.
  enum class Ahead { site, corner, around, star };
  void prefetch(SiteId id, Ahead what) const;

  /// Verifies orientation, adjacency, local regularity, edge lengths, dual vertices, the Euler number and the
  /// witnesses of hidden sites; throws Bug. O(n).
  void check() const { geom::check(triangulation_); }

 private:
  Triangulation2 triangulation_;
  Insertion2 insertion_;
  Removal2 removal_;
};

}  // namespace geom
