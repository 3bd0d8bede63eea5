#include "fpo/tiles/known_cells.h"

#include <cmath>

namespace fpo {

KnownCells::KnownCells(const geom::RestrictedDual& whole) {
  cells_.reserve(whole.num_sites());
  for (SiteId x(0); x.index() < whole.num_sites(); x = SiteId(x.value + 1)) {
    cells_.push_back({whole.known_cell(x), std::numeric_limits<double>::infinity()});
    raise_power(whole.reach_bound(x));
  }
}

void KnownCells::set(SiteId x, const geom::RestrictedDual& dual, SiteId here, const TileGuard& guard) {
  Cell& cell = cells_[x.index()];
  cell.known = dual.known_cell(here);
  cell.room = guard.room_around(dual.site(here).position);
  geom::Sheet& sheet = cell.known.sheet;
  if (!(sheet.radius() < guard.room_around(sheet.center))) sheet = {};
}

/// Is its cell known, and all of it in a part of the surface that has so much room around the site?
bool KnownCells::is_known(SiteId x, double weight, double room) const {
  const auto& [known, room_before] = cells_[x.index()];
  const double distance = std::sqrt(std::max(power_ + weight, 0.0)) * (1 + 1e-9);
  return known.shape == geom::CellShape::regular && distance < std::min(room, room_before);
}

geom::KnownCell KnownCells::of(SiteId x, const geom::WeightedPoint3& site, const TileGuard& guard) const {
  geom::KnownCell result = cells_[x.index()].known;
  const double room = guard.room_around(site.position);
  if (room < 0)
    result.shape = geom::CellShape::irregular;  // it is not moved
  else if (!is_known(x, site.weight, room))
    result.shape = geom::CellShape::unknown;
  if (!(result.sheet.radius() < guard.room_around(result.sheet.center))) result.sheet = {};
  return result;
}

std::vector<geom::KnownCell> KnownCells::of_all(const WeightedSamples& samples) const {
  std::vector<geom::KnownCell> result;
  result.reserve(samples.size());
  for (SiteId x(0); x.index() < samples.size(); x = SiteId(x.value + 1)) {
    result.push_back(cells_[x.index()].known);
    if (!is_known(x, samples.weight(x), std::numeric_limits<double>::infinity()))
      result.back().shape = geom::CellShape::unknown;
  }
  return result;
}

}  // namespace fpo
