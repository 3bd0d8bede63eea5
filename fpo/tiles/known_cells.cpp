#include "fpo/tiles/known_cells.h"

#include <algorithm>
#include <cmath>

namespace fpo {

KnownCells::KnownCells(std::size_t num_samples, std::size_t num_tiles)
    : cells_(num_samples), reaches_(num_samples <= most_with_circles ? num_samples : 0), told_(num_tiles) {}

KnownCells::KnownCells(const geom::RestrictedDual& whole) : KnownCells(whole.num_sites(), 1) {
  for (SiteId x(0); x.index() < whole.num_sites(); x = SiteId(x.value + 1)) {
    cells_[x.index()] = {whole.known_cell(x), std::numeric_limits<double>::infinity()};
    if (has_circles()) reaches_[x.index()] = whole.reach_bound(x);
    raise_power(whole.reach_bound(x));
  }
  if (!has_circles()) return;
  std::vector<geom::EmptyCircle> circles;
  for (const CircleId c : whole.circles())
    if (is_any_regular(whole.circle(c))) circles.push_back(whole.circle(c));
  set_circles(0, std::move(circles));
  end_round();
}

bool KnownCells::is_any_regular(const geom::EmptyCircle& circle) const {
  return std::ranges::any_of(circle.sites, [&](SiteId s) {
    return s.valid() && cells_[s.index()].known.shape == geom::CellShape::regular;
  });
}

void KnownCells::end_round() {
  if (!has_circles()) return;
  circles_.clear();
  for (std::vector<geom::EmptyCircle>& told : told_) {
    circles_.insert(circles_.end(), told.begin(), told.end());
    std::vector<geom::EmptyCircle>().swap(told);
  }
  begin_.assign(cells_.size() + 1, 0);
  const auto for_sites = [&](auto visit) {
    for (std::size_t i = 0; i < circles_.size(); ++i)
      for (const SiteId s : circles_[i].sites)
        if (s.valid()) visit(s.index(), static_cast<std::uint32_t>(i));
  };
  for_sites([&](std::size_t s, std::uint32_t) { ++begin_[s + 1]; });
  for (std::size_t s = 0; s < cells_.size(); ++s) begin_[s + 1] += begin_[s];
  of_site_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for_sites([&](std::size_t s, std::uint32_t i) { of_site_[next[s]++] = i; });
}

void KnownCells::set(SiteId x, const geom::RestrictedDual& dual, SiteId here, const TileGuard& guard) {
  Cell& cell = cells_[x.index()];
  cell.known = dual.known_cell(here);
  cell.room = guard.room_around(dual.site(here).position);
  if (has_circles()) reaches_[x.index()] = dual.reach_bound(here);
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
