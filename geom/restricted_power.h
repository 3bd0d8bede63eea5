#pragma once
// The restricted power diagram of a surface (paper, section 4.1) under insertion and removal of sites
// (section 4.2).
//
// A fragment is the part of one cell on one facet, a convex polygon (clip.h). A corner of the diagram is an
// empty circle: its center is the corner, radius2 its power to the sites that meet there, and no site is
// nearer. Type C corners are the candidates for the farthest point in the paper; power being convex on a
// fragment, the farthest point of the whole surface can also be of type B (border, crease) or A (tip):
// CornerTypes says which are registered.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geom/cell_assembly.h"
#include "geom/cell_division.h"
#include "geom/empty_circles.h"
#include "geom/fragment_store.h"
#include "geom/neighbour_source.h"

namespace geom {

enum class CornerTypes { c_only, all };

/// The diagram and its updates. Exact: after each update the fragments and their labels are those of the
/// diagram of the present sites built from nothing.
class RestrictedPower {
 public:
  /// What one update did. Valid until the next one. An id may be erased and created in the same change: erase
  /// first.
  struct Change {
    std::vector<CircleId> circles_erased, circles_created;
    std::vector<CircleId> circles_moved;  ///< other centers, the same sites; by after_move() only
    std::vector<SiteId> cells;            ///< that won or lost something, the site itself left out
    struct Piece {
      SiteId site;
      FacetId facet;
    };
    std::vector<Piece> erased, created, cut;  ///< fragments gone, new, with another polygon
  };

  /// Empty. Keeps references: to the mesh, and to the source, which must hold the same sites (see after_*).
  /// Throws InputError if the mesh has no facet.
  RestrictedPower(const TriMesh& mesh, NeighbourSource& neighbours, CornerTypes types);
  RestrictedPower(const RestrictedPower&) = delete;

  /// The diagram of sites 0, 1, ... at once, it being empty; the source holds them. `search` must, too, and answer
  /// from several threads: a SiteTree. The number of threads does not matter to the result. The change does not list
  /// the fragments: they are all. No facet may be degenerate. Cost: the facets and the fragments, times the logarithm of the number of sites.
  const Change& build(std::span<const WeightedPoint3> points, const NeighbourSource& search, int threads);
  /// Makes room for p's cell; p has just been inserted into the neighbour source. Cost: the fragments of its
  /// rivals.
  const Change& after_insert(SiteId p, const WeightedPoint3& point);
  /// Gives p's cell to its heirs; p has just been removed from the neighbour source.
  const Change& after_remove(SiteId p);

  // A removal and an insertion in one, for a site that mostly comes back nearby. First the removal is only planned
  // (restricted_power_plan.cpp), and the plan tells the circles that it would bring; then one of three follows.
  struct Plan {
    std::span<const SiteId> heirs;         ///< those met so far
    std::span<const EmptyCircle> circles;  ///< some maybe more than once
    double max_radius2;                    ///< an upper bound of the power that p's cell would have
    double complete_above;  ///< no circle is missing of a larger radius2, or at all if -infinity
    bool is_complete() const { return complete_above == -std::numeric_limits<double>::infinity(); }
  };
  /// p has just been removed from the source. None if p has no cell, or all of its surface alone, or with
  /// CornerTypes::all: then after_remove() is the way.
  std::optional<Plan> plan_removal(SiteId p);
  /// Now with all circles; the heirs are those that get a share. p is still out. Ends the plan before it.
  Plan complete_plan(SiteId p);
  /// What after_remove() does.
  const Change& carry_out_removal(SiteId p);
  /// p has just been inserted into the source at another place: the same diagram as by after_remove() and
  /// after_insert(), for less.
  const Change& after_move(SiteId p, const WeightedPoint3& point);
  /// p has just been inserted into the source where it was.
  void stay(SiteId p) { neighbours_.set_reach(p, reach_[p]); }

  /// Takes these fragments away from their owner p and divides them among the other sites, those in
  /// `excluded` left out, as if only there p did not exist. From then on the diagram is no power diagram: no
  /// insertion or removal may follow. `search` must hold all sites. Does nothing if no other site borders the
  /// fragments, or if the shares do not fit together because of what was abandoned before.
  const Change& abandon(SiteId p, std::span<const FragmentId> fragments, std::span<const SiteId> excluded,
                        const NeighbourSource& search);

  /// p will be removed in about so many moves, 4 to 1: asks the memory for what is needed next to find its cell.
  /// To be called with each of these numbers in turn. No effect but on speed.
  void expect(SiteId p, int moves) const;

  const WeightedPoint3& site(SiteId p) const { return sites_[p]; }
  const EmptyCircle& circle(CircleId c) const { return circles_[c]; }
  /// The order of circles of equal radius2: by facet, place and sites.
  bool circle_before(CircleId a, CircleId b) const { return circle_before(circles_[a], circles_[b]); }
  static bool circle_before(const EmptyCircle& a, const EmptyCircle& b);

  const FragmentStore& fragments() const { return store_; }
  const TriMesh& mesh() const { return mesh_; }
  /// An upper bound of the power of the locations in p's cell; -infinity if that has always been empty.
  double reach(SiteId p) const { return reach_[p]; }

  /// The circles that touch p, each once, in an order that depends on history: the corners of its cell.
  CircleId first_circle(SiteId p) const { return circles_.first(p); }
  CircleId next_circle(CircleId c, SiteId p) const { return circles_.next(c, p); }
  /// The sites that share a circle with p, ascending: with type C corners the link of p in the dual, the
  /// restricted regular triangulation.
  void link(SiteId p, std::vector<SiteId>& out) const;

  /// A fragment by labels alone, the cycle starting at its smallest label.
  struct Canonical {
    FacetId facet;
    SiteId site;
    std::vector<EdgeLabel> labels;
    auto operator<=>(const Canonical&) const = default;
  };
  /// The whole diagram, sorted: equal diagrams give equal lists. For tests.
  std::vector<Canonical> canonical() const;
  /// Verifies lists, labels on both sides of each bisector, registered circles, the source's bounds; throws
  /// Bug. O(fragments).
  void check() const;

 private:
  void begin(SiteId p);
  void admit(SiteId p, const WeightedPoint3& point);
  void finish();
  void touch_cell(SiteId j);

  /// A site from which p may win something.
  struct Rival {
    SiteId site;
    Bisector bisector;  ///< with p
    bool changed = false;
  };
  /// A fragment of a rival of which p may win something.
  struct Prospect {
    FragmentId fragment;
    std::size_t rival;  ///< index into rivals_
    Clip whole;         ///< what is known of its facet
  };
  void occupy_everything(SiteId p);
  void meet_rivals(SiteId p);
  void take_from(const Prospect& prospect, SiteId p);
  void note_losses();
  void cut_polygon(FacetId t, SiteId j, std::span<const PolygonCorner> corners, SiteId p, const Bisector& b);

  bool vacate(SiteId p);
  void divide_vacancy(SiteId p);
  bool add_missing_heirs(SiteId p, const NeighbourSource& source);
  struct Seam {
    std::size_t in_old, in_share;  ///< the edges labelled p
    bool fits;                     ///< and the edges next to them continue each other
  };
  Seam seam_of(FragmentId old, const FacetPolygon& share, SiteId p) const;
  void join(FragmentId old, const FacetPolygon& share, SiteId p);
  void unite(FragmentId old, const FacetPolygon& share, const Seam& seam, FacetPolygon& out) const;
  void carry_out_division(SiteId p);

  /// A vacated fragment that borders at most one site. Where facets are smaller than cells, most do.
  struct Simple {
    double bound;  ///< of the power there without p
    std::size_t vacated;
    SiteId neighbour;  ///< or none
  };
  void defer_simple();
  SiteId nearest_heir(const Vec3& location) const;
  void divide_where_largest(SiteId p);
  Plan present_plan(SiteId p);
  static bool brings_circle(const CellCorner& corner, SiteId p);
  void list_planned_circles(SiteId p);
  void settle_deferred(SiteId p, const WeightedPoint3& point);
  bool wins_over_all_but(SiteId neighbour, FragmentId vacated) const;
  void redraw(FragmentId f, const FacetPolygon& share, SiteId p);
  bool keeps_its_edges(FragmentId f, const FacetPolygon& share, const Seam& seam, const Bisector& b) const;
  void move_edge(FragmentId f, std::size_t edge, SiteId p, const Bisector& b);
  void take_new_shares(SiteId p);
  double redraw_own(const CellAssembly::TouchedFacet& touched, SiteId p);
  bool move_corners(FragmentId f);
  void move_circle(const PolygonCorner& corner);

  double commit(FragmentId f, FacetPolygon& polygon);
  void forget(FragmentId f);
  void register_corners(FacetPolygon& polygon);
  void register_on_edge(FacetPolygon& polygon, std::size_t k);
  void register_at_vertex(const FacetPolygon& polygon, std::size_t k);
  CircleId create_circle(const FacetPolygon& polygon, std::size_t corner, std::int32_t place);
  void center_circle(EmptyCircle& circle, const Vec3& corner) const;
  void erase_circle_of(const PolygonCorner& corner) {
    if (corner.circle.valid()) erase_circle(corner.circle);
  }
  void erase_circle(CircleId c);

  const TriMesh& mesh_;
  NeighbourSource& neighbours_;
  CornerTypes types_;
  Clipper::Sites sites_;
  double extent_;
  Clipper clipper_;
  FragmentStore store_;
  EmptyCircles circles_;
  Table<SiteId, double> reach_;
  Table<VertexId, FacetId> first_facet_;     ///< CornerTypes::all only: where a vertex's circle is registered
  Table<VertexId, CircleId> vertex_circle_;  ///< likewise

  Change change_;
  CellDivision division_;
  CellAssembly assembly_;
  // Workspaces of one update.
  std::vector<SiteId> candidates_;
  std::vector<Rival> rivals_;  ///< of an insertion, ascending
  std::vector<Prospect> prospects_;
  std::vector<FragmentId> vacated_;
  std::vector<char> beaten_;
  FacetPolygon polygon_, union_;
  // Of a plan.
  std::vector<SiteId> heirs_of_plan_;
  std::vector<std::size_t> at_once_;  ///< vacated fragments that are divided
  std::vector<Simple> deferred_;      ///< those that are not yet
  std::vector<SiteId> strangers_;     ///< that might be heirs, but are of nothing divided
  std::vector<Rival> contenders_;  ///< the heirs and strangers, and their bisectors with p at its new place
  std::vector<EmptyCircle> planned_circles_;
  Table<SiteId, std::uint32_t> cell_stamp_;
  std::uint32_t stamp_ = 0;
};

}  // namespace geom
