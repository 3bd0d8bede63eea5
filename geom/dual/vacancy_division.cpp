#include "geom/dual/vacancy_division.h"

#include <algorithm>

namespace geom {

void VacancyDivision::divide(SiteId p, const CellPieces& cell, double reach) {
  heirs_.begin(p, cell);
  do {
    shares_.clear();
    new_corners_.clear();
    heirs_.close();
    power_ = reach;
    for (const CellPieces::Piece& piece : cell.pieces) {
      const std::size_t first = shares_.pieces.size();
      piece_.divide(piece.facet, cell.corners_of(piece));
      note_new_corners(first);
    }
  } while (add_missing_heirs(reach));
}

void VacancyDivision::note_new_corners(std::size_t first_share) {
  for (std::size_t i = first_share; i < shares_.pieces.size(); ++i) {
    const CellPieces::Piece& piece = shares_.pieces[i];
    const std::span<const PolygonCorner> share = shares_.corners_of(piece);
    for (std::size_t k = 0; k < share.size(); ++k) {
      if (!is_new(share, k)) continue;
      power_ = std::max(power_, state_.clipper.bound_power(piece.facet, piece.owner, share.subspan(k, 1)));
      new_corners_.add(piece.facet, piece.owner, share, k);
    }
  }
}

bool VacancyDivision::add_missing_heirs(double reach) {
  const std::size_t known = heirs_.size();
  const SiteId p = heirs_.p();
  new_corners_.group();
  candidates_.clear();
  state_.search.near({p, state_.sites[p].position, state_.distance_at(reach, p), power_}, candidates_);
  for (const SiteId j : candidates_)
    if (j != p && heirs_.index_of(j) >= known && new_corners_.any_beaten_by(j)) heirs_.add(j);
  return heirs_.size() > known;
}

}  // namespace geom
