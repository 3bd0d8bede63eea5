#pragma once
// How the part of a cell on one facet is divided among its heirs (vacancy_division.h).

#include <span>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/state.h"
#include "geom/dual/vacancy_heirs.h"

namespace geom {

/// One object serves many parts.
class PieceDivision {
 public:
  /// Keeps references. What heirs get is added to the shares.
  PieceDivision(const DualState& state, VacancyHeirs& heirs, CellPieces& shares)
      : state_(state), heirs_(heirs), shares_(shares), lazy_(state.clipper) {}

  /// `corners`: those of the part. An edge of a share on the border of the cell is labelled with its site.
  void divide(FacetId t, std::span<const PolygonCorner> corners);

 private:
  using Heir = VacancyHeirs::Heir;
  /// The power less that to p at a corner of the part in hand is between these.
  struct Lead {
    double least, most;
  };
  void find_winners(FacetId t, std::span<const PolygonCorner> corners);
  bool is_dominated(Heir k, Heir by, std::size_t num_corners) const;
  void order_winners(std::span<const PolygonCorner> corners);
  void add_share(FacetId t, std::span<const PolygonCorner> corners, std::size_t winner);
  template <class Visit>
  void for_rivals(std::size_t winner, Visit visit) const;
  const RoundedPoint* known_corner(FacetId t, std::span<const PolygonCorner> corners, EdgeLabel own,
                                   EdgeLabel before, EdgeLabel after) const;

  const DualState& state_;
  VacancyHeirs& heirs_;
  CellPieces& shares_;
  std::vector<Lead> leads_;    ///< of each heir at each corner
  std::vector<double> least_;  ///< of each heir, of these
  /// On the part in hand, maybe some that win nothing; those that it is labelled with first, in cyclic order.
  std::vector<Heir> winners_;
  std::size_t num_labels_ = 0;
  FacetPolygon polygon_;
  LazyPolygon lazy_;
};

}  // namespace geom
