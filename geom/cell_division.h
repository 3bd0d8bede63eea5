#pragma once
// How the cell of a removed site is divided among its heirs (paper, section 4.2, figure 6 (c)).
//
//          i   i|h    h               P, the part of the cell on one facet, is convex and bounded by other cells
//        o------+--------o            and by edges of the facet. The new diagram inside P is a tree: walking
//       /        \        \  h        around P, the owner changes at junctions (+), at each junction an edge of
//    i o          \        o          the new diagram begins, and three of them meet in a corner of type C.
//       \          *------+           So the junctions and a few tests for more than three owners give all of it.
//        \        /  h|k /
//         o------+------o             On an edge labelled i the heir i is nearest; along an edge of the facet the
//          facet edge, k              owners are found in one dimension, once for both facets there.

#include <span>
#include <vector>

#include "geom/fragment_store.h"

namespace geom {

/// Plans the division, changes nothing. One object serves all removals of a diagram. No allocation once its
/// tables have grown.
class CellDivision {
 public:
  /// What an heir gets of one vacated fragment: a polygon in which the edge on the removed site's bisector, if
  /// there is one, is labelled with that site.
  struct Share {
    FragmentId joins;  ///< the fragment of the heir that continues it across that edge, or none: it is new
    FacetPolygon polygon;
  };

  /// Keeps references.
  CellDivision(const TriMesh& mesh, const Clipper::Sites& sites, Clipper& clipper,
               const FragmentStore& store);

  /// Starts anew: these fragments of p are to be divided. Heirs are the sites that their edges are labelled
  /// with, `excluded` left out.
  void begin(SiteId p, std::span<const FragmentId> vacated, std::span<const SiteId> excluded = {});
  std::span<const SiteId> heirs() const { return heirs_; }
  /// Neither an heir nor p nor excluded?
  bool is_stranger(SiteId j) const { return j.index() >= known_stamp_.size() || known_stamp_[j] != stamp_; }
  void add_heir(SiteId k);

  /// Divides among the present heirs (at least one). Requires that every edge of the vacated fragments that
  /// is no facet edge is labelled with an heir that is nearest there after p: true if p is removed and nobody
  /// is excluded.
  void divide();
  /// The same fragment by fragment, each named by its place among the vacated ones: first start(), after which no heir
  /// may be added, then for each divide(), or leave_to() the heir that its only edge with a site is labelled with
  /// (where no other heir will have anything once p is back), or neither (where p will have all).
  void start();
  void divide(std::size_t vacated);
  void leave_to(SiteId heir, std::size_t vacated);
  /// The same without that requirement, slower: the share of heir k on facet t is clipped from
  /// { x in t : p beats k at x, and k beats every other heir at x }. misfit(): a share that should lie along
  /// the edge between p and k is empty.
  void divide_by_clipping();

  /// Of the last division; for the caller to move from or read.
  std::span<Share> shares() { return std::span(shares_).first(num_shares_); }
  bool misfit() const { return misfit_; }
  /// Those that were not corners of the cell; maybe more than once, with different owners.
  std::span<const CellCorner> corners() const { return corners_; }
  /// Is j nearer than the heirs somewhere in the vacated fragments? It is iff it is at a corner of the
  /// division that was not one of the cell, because the difference of two powers is affine on each share.
  bool is_missing(SiteId j, std::size_t first_corner = 0) const;
  /// An upper bound of the power, after the division, at those corners.
  double max_radius2() const;

 private:
  using Heir = std::size_t;  // index into heirs_
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Node {  // of the outline of a share under construction, counterclockwise
    RoundedPoint point;
    EdgeLabel edge;  ///< that starts there
    std::size_t next;
  };
  struct Run {  // of one owner along the boundary; later also along edges of the new diagram
    Heir heir;
    std::size_t first, last;  ///< nodes
  };
  struct Crossing {  // on a facet edge
    Heir from, to;
    RoundedPoint point;
  };
  struct Range {
    std::size_t first = none, count = 0;
  };

  void trace_boundary(std::size_t vacated, std::span<const PolygonCorner> corners);
  Heir owner_of_vertex(FacetId t, int corner);
  Range crossings_on_edge(std::size_t vacated, int e, Heir first, Heir last);
  bool copy_from_across(FacetId t, int e);
  void insert_crossings(FacetId t, int e, Heir h, std::size_t begin);
  bool holds_island(std::size_t first) const;
  void close_cycle(FacetId t, std::size_t begin);
  bool find_repetition(std::size_t begin, std::size_t& r, std::size_t& s) const;
  bool is_ear(FacetId t, std::size_t begin, std::size_t b) const;
  void cut_ear(FacetId t, std::size_t begin, std::size_t b);
  void append(Run& run, const RoundedPoint& point, EdgeLabel edge);
  void emit(std::size_t vacated, const Run& run);

  void clip_shares(std::size_t vacated);
  void find_old_fragments();
  FragmentId old_fragment(std::size_t vacated, Heir h) const {
    return old_fragments_[vacated * heirs_.size() + h];
  }
  void order_heirs(FragmentId vacated);
  bool inherits_whole(FacetId t);
  bool yields_everywhere(Heir i, std::span<const PolygonCorner> corners) const;

  void prepare();
  Share& add_share();
  SiteId site(const Run& run) const { return heirs_[run.heir]; }
  const Bisector& bisector(Heir k, Heir h) const { return bisectors_[k * heirs_.size() + h]; }

  const TriMesh& mesh_;
  const Clipper::Sites& sites_;
  Clipper& clipper_;
  const FragmentStore& store_;

  SiteId p_;
  std::vector<FragmentId> vacated_;
  std::vector<FacetId> vacated_facets_;
  std::vector<SiteId> heirs_;
  std::vector<Bisector> bisectors_;  ///< row k, column h: of owner heirs_[k] and heirs_[h]
  Table<SiteId, std::uint32_t> known_stamp_;
  Table<SiteId, std::uint32_t> heir_index_;
  std::uint32_t stamp_ = 0;
  std::vector<Share> shares_;
  std::size_t num_shares_ = 0;
  std::vector<CellCorner> corners_;  ///< of the division, those of the cell left out
  bool misfit_ = false;

  // Of divide().
  std::vector<Node> nodes_;
  std::vector<Run> runs_;      ///< a stack of cycles
  std::vector<Run> outlines_;  ///< one run of each owner
  std::vector<Crossing> crossings_;
  std::vector<std::array<Range, 3>> edge_crossings_;  ///< of each vacated fragment
  Table<FacetId, std::int32_t> vacated_index_;        ///< into vacated_, or -1
  Table<VertexId, std::uint32_t> vertex_stamp_, vertex_owner_;
  std::uint32_t vertex_stamp_now_ = 0;
  std::vector<FragmentId> old_fragments_;  ///< row: vacated fragment, column: what the heir has on that facet
  // Of divide_by_clipping().
  std::vector<Heir> order_;  ///< those that matter most on the facet in hand first
  std::vector<char> beaten_;
  FacetPolygon polygon_;
};

}  // namespace geom
