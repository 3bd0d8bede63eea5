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

#include <span>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/new_corners.h"
#include "geom/dual/piece_division.h"
#include "geom/dual/state.h"
#include "geom/dual/vacancy_heirs.h"

namespace geom {

/// Plans the division, changes nothing. One object serves all divisions of a state.
class VacancyDivision {
 public:
  explicit VacancyDivision(const DualState& state)
      : state_(state), heirs_(state), piece_(state, heirs_, shares_), new_corners_(state) {}
  VacancyDivision(const VacancyDivision&) = delete;

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
    const EdgeLabel own = EdgeLabel::bisector(heirs_.p());
    return share[corner].edge != own && share[previous_corner(corner, share.size())].edge != own;
  }

 private:
  void note_new_corners(std::size_t first_share);
  bool add_missing_heirs(double reach);

  const DualState& state_;
  VacancyHeirs heirs_;
  CellPieces shares_;
  PieceDivision piece_;
  NewCorners new_corners_;
  double power_ = 0;
  std::vector<SiteId> candidates_;
};

}  // namespace geom
