#include "geom/dual/vacancy_heirs.h"

namespace geom {

void VacancyHeirs::begin(SiteId p, const CellPieces& cell) {
  p_ = p;
  sites_.clear();
  for (const CellPieces::Piece& piece : cell.pieces)
    for (const PolygonCorner& corner : cell.corners_of(piece))
      if (corner.edge.is_site() && std::ranges::find(sites_, corner.edge.site()) == sites_.end())
        sites_.push_back(corner.edge.site());
  const WeightedPoint3& site = state_.sites[p];
  if (sites_.empty()) sites_.push_back(state_.search.nearest({site.position, site.level}, p).site);
  before_p_.clear();
  for (const SiteId k : sites_) before_p_.push_back(state_.clipper.bisector_of(p, k));
}

void VacancyHeirs::add(SiteId j) {
  sites_.push_back(j);
  before_p_.push_back(state_.clipper.bisector_of(p_, j));
}

}  // namespace geom
