#pragma once
// Dynamic regular triangulation of weighted points on the flat torus (paper, section 3.1), the dual of the
// periodic power diagram.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/exact/predicates.h"
#include "geom/ids.h"
#include "geom/regular/flat_torus.h"
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
  using Triangle = std::array<SiteId, 3>;  ///< corners counterclockwise

  /// What one insertion or removal did. Valid until the next one. The id of a destroyed triangle may be in
  /// use again, hence in both lists.
  struct Change {
    std::span<const SimplexId> destroyed;
    std::span<const SimplexId> created;
    std::span<const SiteId> hidden;   ///< sites that lost their last triangle (the inserted one included)
    std::span<const SiteId> exposed;  ///< sites that were hidden and are vertices now
  };
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

  const FlatTorus& torus() const { return torus_; }
  bool contains(SiteId id) const { return id.valid() && id.index() < sites_.size() && sites_[id].at.valid(); }
  bool is_hidden(SiteId id) const { return contains(id) && sites_[id].next_hidden != not_hidden; }
  WeightedPoint2 point(SiteId id) const { return {{sites_[id].x, sites_[id].y}, sites_[id].weight}; }
  /// The shortest vector from a to b: the edge, if they are joined.
  Vec2 difference(SiteId a, SiteId b) const {
    return torus_.shortest({sites_[b].x - sites_[a].x, sites_[b].y - sites_[a].y});
  }
  /// The site other than `id` with the least power at the position of `id`. Expected O(1).
  Nearest nearest_other(SiteId id) const;
  /// The sites joined to `id` by an edge, counterclockwise. Empty for a hidden site.
  void link(SiteId id, std::vector<SiteId>& out) const;
  /// Calls visit(triangle, index of the corner `id` in it), counterclockwise. `id` must be visible.
  template <class Visit>
  void visit_star(SiteId id, Visit&& visit) const;

  std::size_t simplex_capacity() const { return simplices_.size(); }  ///< ids of triangles are below
  bool is_live(SimplexId t) const { return simplices_[t].corner[0].valid(); }
  const Triangle& corners(SimplexId t) const { return simplices_[t].corner; }
  /// The dual power vertex, coordinates in [0, period], rounded, and its power to the corners. radius2 is
  /// computed from the corner of smallest id, so its bits are a function of the triangle alone.
  Vec2 center(SimplexId t) const { return {simplices_[t].center_x, simplices_[t].center_y}; }
  double radius2(SimplexId t) const { return simplices_[t].radius2; }
  /// An order of live triangles by their corners (ids), whatever their ids.
  bool simplex_before(SimplexId a, SimplexId b) const;
  std::vector<Triangle> triangles() const;  ///< smallest corner first, in no particular order

  // Hints to the memory, for a site that will be removed soon. Each loads what the next one reads, so they
  // are best called some time apart: the site; a triangle at it; that one's neighbours and corners; the star.
  void prefetch(SiteId id) const { __builtin_prefetch(&sites_[id]); }
  void prefetch_corner(SiteId id) const;
  void prefetch_around(SiteId id) const;
  void prefetch_star(SiteId id) const;

  /// Verifies orientation, adjacency, local regularity, edge lengths, dual vertices, the Euler number and the
  /// witnesses of hidden sites; throws Bug. O(n).
  void check() const;

 private:
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
    double center_x, center_y, radius2;
    float tolerance;      ///< of the filter: relative, or infinite if the center is not known well enough
    SiteId first_hidden;  ///< the sites that it witnesses, a list through Site::next_hidden
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
  /// A site seen from an origin: the one being inserted or removed, or a location.
  struct Corner {
    double x, y, weight;
    SiteId id;
  };
  /// An edge of the hole around a site: from its corner k to the next, and the side beyond.
  struct Chain {
    std::int32_t first, apex, last;     ///< corners of the hole: a triangle on the chord (last, first)
    std::array<std::int32_t, 2> child;  ///< chains of the chords (first, apex), (apex, last); -1: an edge
    Side closing;                       ///< the triangle's side on the chord, once it exists
  };
  struct HoleScale {
    double orientation, comparison;  ///< error bounds of the two filters
  };

  static int next(int corner) { return corner == 2 ? 0 : corner + 1; }
  static int previous(int corner) { return corner == 0 ? 2 : corner - 1; }

  void admit(SiteId id, const WeightedPoint2& point);
  void begin_change();
  Change change() const { return {destroyed_, created_, hidden_, exposed_}; }
  void normalize_change();

  void start_with_lattice(std::size_t first_id, double weight);
  SimplexId create(const Corner& a, const Corner& b, const Corner& c);
  void destroy(SimplexId t) {
    simplices_[t].corner[0] = SiteId();
    free_.push_back(t);
    destroyed_.push_back(t);
  }
  void glue(Side one, Side other) {
    simplices_[one.simplex()].mate[static_cast<std::size_t>(one.corner())] = other;
    simplices_[other.simplex()].mate[static_cast<std::size_t>(other.corner())] = one;
  }
  void set_dual(Simplex& t, const Corner& base, const Corner& b, const Corner& c);

  Corner seen_from(const Site& origin, SiteId id) const {
    const Site& s = sites_[id];
    return {torus_.shortest_x(s.x - origin.x), torus_.shortest_y(s.y - origin.y), s.weight, id};
  }
  bool in_conflict(const Simplex& t, SiteId e, int corner) const;
  bool in_conflict_exactly(const Simplex& t, SiteId e, int corner) const;
  SimplexId locate(SiteId e, SimplexId start) const;

  void insert_visible_or_hide(SiteId e, SimplexId hint);
  void dig_cavity(SiteId e, SimplexId start);
  void star_cavity(SiteId e);
  void release_corners_of_cavity();
  void settle_displaced();
  void expose_orphans();
  void hide(SiteId id, SimplexId witness);
  void unlink_hidden(SiteId id);
  void take_hidden_of(const Simplex& t);

  void open_hole(SiteId p);
  HoleScale hole_scale() const;
  void plan_hole(const HoleScale& scale);
  std::int32_t apex(std::int32_t first, std::int32_t last, const HoleScale& scale) const;
  void require_short_chords() const;
  void fill_hole(SiteId p);

  double covered_area() const;
  void check_simplex(SimplexId id) const;
  void check_site(SiteId id) const;

  FlatTorus torus_;
  Table<SiteId, Site> sites_;
  Table<SimplexId, Simplex> simplices_;
  std::vector<SimplexId> free_;
  SimplexId recent_;             ///< a live triangle: the last created
  double weight_allowance_ = 0;  ///< three times the largest |w| so far: for the filter
  std::uint32_t mark_ = 0;

  std::vector<SimplexId> destroyed_, created_;  ///< the current change
  std::vector<SiteId> hidden_, exposed_;
  std::vector<SiteId> displaced_;  ///< hidden sites whose witness is destroyed
  std::vector<SiteId> released_;   ///< corners of a cavity, some of which may be swallowed
  std::vector<SiteId> orphans_;    ///< displaced by a removal, so perhaps exposed
  std::vector<Side> pending_;      ///< sides of the cavity still to be crossed
  std::vector<Corner> rim_;        ///< corners of the cavity or hole, counterclockwise
  std::vector<Side> beyond_;       ///< the sides outside its edges: beyond_[k] from rim_[k] to the next
  std::vector<SimplexId> star_;    ///< its triangles
  std::vector<Chain> plan_;        ///< how the hole will be filled
  std::vector<std::array<std::int32_t, 4>> chords_;  ///< first, last, parent, which child: to be planned
};

template <class Visit>
void Regular2::visit_star(SiteId id, Visit&& visit) const {
  const Side start = sites_[id].at;
  Side here = start;
  do {
    const Simplex& t = simplices_[here.simplex()];
    visit(here.simplex(), here.corner());
    // From (id, a, b) across (id, b), which lies opposite a: there the corners are (id, b, c), c opposite.
    const Side across = t.mate[next(here.corner())];
    here = Side(across.simplex(), next(across.corner()));
  } while (here != start);
}

}  // namespace geom
