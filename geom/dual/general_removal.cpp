#include "geom/dual/general_removal.h"

#include <algorithm>
#include <limits>

namespace geom {

void GeneralRemoval::plan(SiteId p) {
  p_ = p;
  found_.clear();
  heirs_.clear();
  reach_ = clipper_.clip(p, cell_);
  has_neighbours_ =
      std::ranges::any_of(cell_.corners, [](const PolygonCorner& c) { return c.edge.is_site(); });
  const std::span<const CircleId> star = state_.circles.of_site(p);
  star_.assign(star.begin(), star.end());
  power_ = reach_;
  edges_.begin(p, star_, {});
  if (state_.search.size() == 1) return division_.clear();
  division_.divide(p, cell_, reach_);
  power_ = division_.power();
  find_circles();
  edges_.begin(p, star_, found_);
  edges_.add(division_.shares());
  edges_.join_across();
}

/// And who gets something.
void GeneralRemoval::find_circles() {
  const CellPieces& shares = division_.shares();
  for (const CellPieces::Piece& piece : shares.pieces) {
    const std::span<const PolygonCorner> share = shares.corners_of(piece);
    if (std::ranges::find(heirs_, piece.owner) == heirs_.end()) heirs_.push_back(piece.owner);
    EmptyCircle circle;
    for (std::size_t k = 0; k < share.size(); ++k)
      if (division_.is_new(share, k) && state_.corners.find({piece.facet, piece.owner, share}, k, circle))
        found_.push_back(circle);
  }
  std::ranges::sort(heirs_);
  std::ranges::sort(found_, circle_before);
}

void GeneralRemoval::commit(DualChange& change) {
  if (state_.paper) state_.paper->remove(p_);
  state_.leave(p_);
  for (const CircleId c : star_) {
    state_.circles.erase(c);
    change.circles_erased.push_back(c);
  }
  edges_.connect(create_all(found_, state_.circles, change));
  for (const CellPieces::Piece& piece : division_.shares().pieces)
    state_.reach.raise(piece.owner, state_.clipper.bound_power(piece.facet, piece.owner,
                                                               division_.shares().corners_of(piece)));
  change.cells.insert(change.cells.end(), heirs_.begin(), heirs_.end());
  state_.reach.forget(p_);
}

}  // namespace geom
