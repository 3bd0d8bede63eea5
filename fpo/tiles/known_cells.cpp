#include "fpo/tiles/known_cells.h"

#include <cmath>

namespace fpo {

void KnownCells::set(SiteId x, const geom::RestrictedDual& dual, SiteId here, const TileGuard& guard) {
  Cell& cell = cells_[x.index()];
  cell.known = dual.known_cell(here);
  cell.room = guard.room_around(dual.site(here).position);
  geom::Sheet& sheet = cell.known.sheet;
  if (!(sheet.radius() < guard.room_around(sheet.center))) sheet = {};
}

geom::KnownCell KnownCells::of(SiteId x, const geom::WeightedPoint3& site, const TileGuard& guard) const {
  const auto& [known, room_before] = cells_[x.index()];
  geom::KnownCell result = known;
  const double distance = std::sqrt(std::max(power_ + site.weight, 0.0)) * (1 + 1e-9);
  const double room = guard.room_around(site.position);
  if (room < 0)
    result.shape = geom::CellShape::irregular;  // it is not moved
  else if (known.shape != geom::CellShape::regular || !(distance < std::min(room, room_before)))
    result.shape = geom::CellShape::unknown;
  if (!(result.sheet.radius() < guard.room_around(result.sheet.center))) result.sheet = {};
  return result;
}

}  // namespace fpo
