#pragma once
// Triangles on the flat torus, whom they join, and where each site is: what a regular triangulation is made
// of. Its operations (insertion2.h, removal2.h) share it.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/exact/predicates.h"
#include "geom/ids.h"
#include "geom/regular/flat_torus.h"
#include "geom/regular/power_circle.h"
#include "geom/regular/regular_change.h"
#include "geom/vec.h"

namespace geom {

// The corner of a triangle after and before another one.
inline int ccw(int corner) { return corner == 2 ? 0 : corner + 1; }
inline int cw(int corner) { return corner == 0 ? 2 : corner - 1; }

/// Between operations it is what Regular2 promises. Edges are short, so that one corner seen from another is
/// at the shortest periodic difference.
struct Triangulation2 {
  using Triangle = std::array<SiteId, 3>;  ///< corners counterclockwise
  /// The side of a triangle opposite one of its corners; as a place: that corner.
  struct Side {
    std::int32_t code = -1;
    Side() = default;
    Side(SimplexId t, int corner) : code(4 * t.value + corner) {}
    bool valid() const { return code >= 0; }
    SimplexId simplex() const { return SimplexId(code >> 2); }
    int corner() const { return code & 3; }
    bool operator==(const Side&) const = default;
  };
  /// One cache line. A free one has no corners.
  struct alignas(64) Simplex {
    Triangle corner;
    std::array<Side, 3> mate;  ///< the other side of the same edge, by the corner opposite
    PowerCircle circle;        ///< set from the corner of smallest id, so a function of the triangle alone
    SiteId first_hidden;       ///< the sites that it witnesses, a list through Site::next_hidden
    std::uint32_t mark = 0;
  };
  static constexpr SiteId not_hidden{-2};
  /// `at`: a corner where the site is; for a hidden site its witness: a triangle that contains it without
  /// being in conflict with it.
  struct alignas(32) Site {
    double x, y, weight;
    Side at;
    SiteId next_hidden = not_hidden;
  };

  /// Without sites and triangles. Throws InputError (FlatTorus).
  explicit Triangulation2(const Vec2& period) : torus(period) {}

  bool contains(SiteId id) const { return id.valid() && id.index() < sites.size() && sites[id].at.valid(); }
  bool is_hidden(SiteId id) const { return contains(id) && sites[id].next_hidden != not_hidden; }
  bool is_live(SimplexId t) const { return simplices[t].corner[0].valid(); }
  /// The shortest vector from a to b: the edge, if they are joined.
  Vec2 difference(SiteId a, SiteId b) const {
    return torus.shortest({sites[b].x - sites[a].x, sites[b].y - sites[a].y});
  }
  SeenSite seen_from(const Site& origin, SiteId id) const {
    const Site& s = sites[id];
    return {torus.shortest_x(s.x - origin.x), torus.shortest_y(s.y - origin.y), s.weight, id};
  }
  /// Calls visit(triangle, index of the corner `id` in it), counterclockwise. `id` must be visible.
  template <class Visit>
  void visit_star(SiteId id, Visit&& visit) const;
  /// Is site e inside the circle of t? `corner` is one of t's that is less than half a period from e.
  bool in_conflict(const Simplex& t, SiteId e, int corner) const {
    const Site& x = sites[e];
    const int side = t.circle.side(torus, {x.x, x.y}, x.weight, weight_allowance);
    return side == 0 ? in_conflict_exactly(t, e, corner) : side < 0;
  }
  bool in_conflict_exactly(const Simplex& t, SiteId e, int corner) const;
  /// A triangle that contains site e.
  SimplexId locate(SiteId e, SimplexId start) const;

  /// Stores a new site, snapped to the grid, that is nowhere. Throws InputError (Regular2::insert()).
  void admit(SiteId id, const WeightedPoint2& point);
  /// A new triangle of corners seen from one origin, joined to nobody. The change has it.
  SimplexId create(const SeenSite& a, const SeenSite& b, const SeenSite& c);
  void destroy(SimplexId t) {
    simplices[t].corner[0] = SiteId();
    free.push_back(t);
    change.destroyed.push_back(t);
  }
  void glue(Side one, Side other) {
    simplices[one.simplex()].mate[static_cast<std::size_t>(one.corner())] = other;
    simplices[other.simplex()].mate[static_cast<std::size_t>(other.corner())] = one;
  }

  FlatTorus torus;
  Table<SiteId, Site> sites;
  Table<SimplexId, Simplex> simplices;
  std::vector<SimplexId> free;
  SimplexId recent;             ///< a live triangle: the last created
  double weight_allowance = 0;  ///< three times the largest |w| so far: for the filter
  ChangeLists change;           ///< of the operation in hand, or of the last one
};

/// Triangulates a lattice of auxiliary sites with ids from first_id on, all of that weight.
void start_with_lattice(Triangulation2& t, std::size_t first_id, double weight);

/// Verifies all that Regular2 promises; throws Bug. O(n).
void check(const Triangulation2& m);

template <class Visit>
void Triangulation2::visit_star(SiteId id, Visit&& visit) const {
  const Side start = sites[id].at;
  Side here = start;
  do {
    const Simplex& t = simplices[here.simplex()];
    visit(here.simplex(), here.corner());
    // From (id, a, b) across (id, b), which lies opposite a: there the corners are (id, b, c), c opposite.
    const Side across = t.mate[static_cast<std::size_t>(ccw(here.corner()))];
    here = Side(across.simplex(), ccw(across.corner()));
  } while (here != start);
}

}  // namespace geom
