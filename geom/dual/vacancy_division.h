#pragma once
// How the cell of a site is divided among the others if that site is not there (paper, section 4.2, figure 6
// (c)).
//
//      b  \       / c        On a facet the part of p's cell is a convex polygon V, and an edge of V with
//      ____\_____/____       label b means that b wins something next to it. The share of k is { x on the
//         /       \  .       facet: p beats k at x, and k beats the other heirs at x }: where k beats those
//     V  /    p    \         that V is labelled with, p does, too, so it lies within V.
//       /___________\  .
//      /      a      \.
//
// Heirs are found at corners. The difference of two powers is affine on a share, so a site that is no heir
// wins something iff it does at a corner of some share, and not at one on the border of p's cell, as p is
// nearer there.

#include <optional>
#include <span>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/state.h"

namespace geom {

/// Plans the division, changes nothing. One object serves all divisions of a state.
class VacancyDivision {
 public:
  explicit VacancyDivision(DualState& state)
      : state_(state), stamp_of_(state.mesh.num_vertices(), 0), lazy_(state.clipper) {}

  /// `cell`: that of p, which is in, and `reach` the least bound of the power there. Some other site must be
  /// in.
  void divide(SiteId p, const CellPieces& cell, double reach);

  /// There are no shares.
  void clear() { shares_.clear(); }

  /// Not empty; an edge on p's border is labelled p.
  const CellPieces& shares() const { return shares_; }
  /// An upper bound of the power in the cell, with p or without.
  double power() const { return power_; }
  /// Is the corner of a share one that p's cell does not have?
  bool is_new(std::span<const PolygonCorner> share, std::size_t corner) const {
    const EdgeLabel own = EdgeLabel::bisector(p_);
    return share[corner].edge != own && share[previous_corner(corner, share.size())].edge != own;
  }

 private:
  using Heir = std::size_t;  // index into heirs_
  /// A corner that p's cell does not have, and what it takes to see that a site is not nearer there.
  struct NewCorner {
    CellCorner corner;
    double power, distance2;  ///< of the owner
  };
  /// Some new corners of one owner, and a ball about them.
  struct Group {
    std::size_t begin, end;
    Vec3 center;
    double radius;
  };

  void begin(SiteId p, const CellPieces& cell);
  void divide_piece(FacetId t, std::span<const PolygonCorner> corners);
  void order_winners(std::span<const PolygonCorner> corners);
  void find_winners(FacetId t, std::span<const PolygonCorner> corners);
  bool is_dominated(Heir k, Heir by, std::size_t num_corners) const;
  void add_share(FacetId t, std::span<const PolygonCorner> corners, std::size_t winner);
  const RoundedPoint* known_corner(FacetId t, std::span<const PolygonCorner> corners, EdgeLabel own,
                                   EdgeLabel before, EdgeLabel after) const;
  static const RoundedPoint* find_corner(std::span<const PolygonCorner> corners, EdgeLabel one,
                                         EdgeLabel two);
  template <class Visit>
  void for_rivals(std::size_t winner, Visit visit) const;
  void note_new_corners(std::size_t first_share);
  bool is_first(FacetId t, SiteId owner, EdgeLabel before, EdgeLabel after);
  bool add_missing_heirs(double reach);
  void group_new_corners();
  bool is_missing(SiteId j);
  bool is_behind(const WeightedPoint3& j, const WeightedPoint3& owner, const Group& ball) const;
  bool beats_at(SiteId j, const NewCorner& at) const;
  const Bisector& between(Heir k, Heir h);
  Heir index_of(SiteId s) const { return static_cast<Heir>(std::ranges::find(heirs_, s) - heirs_.begin()); }

  /// The power less that to p at a corner of the piece in hand is between these.
  struct Lead {
    double least, most;
  };

  DualState& state_;
  SiteId p_;
  std::vector<SiteId> heirs_;
  std::vector<Bisector> before_p_;  ///< of p and each heir
  std::vector<std::optional<Bisector>> between_;
  std::vector<Lead> leads_;    ///< of each heir at each corner
  std::vector<double> least_;  ///< of each heir, of these
  std::vector<Heir>
      winners_;  ///< on the piece in hand, maybe some that win nothing; the labels first, in cyclic order
  std::size_t num_labels_ = 0;
  CellPieces shares_;
  std::vector<NewCorner> new_corners_;
  std::vector<Group> groups_;
  Table<VertexId, std::uint32_t> stamp_of_;  ///< of the last division where it was a new corner
  std::uint32_t stamp_ = 0;
  double power_ = 0;
  FacetPolygon polygon_;
  LazyPolygon lazy_;
  std::vector<SiteId> candidates_;
};

}  // namespace geom
