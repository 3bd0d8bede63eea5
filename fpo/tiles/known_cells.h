#pragma once
// What a round of tiles finds out about the cells of its samples, for the tiles of the next round and for the
// whole surface in the end; and what is known there before the first round.
//
// Let P bound the power everywhere on the surface after a round: it is the largest reach in any tile's
// diagram, as each location is in a tile's box T, and nobody else changes who owns it (tile_guard.h). All
// that a site owns is within sqrt(P + w) of it. If T holds that ball, the tile's diagram has all of the cell:
// what it says of the cell holds on the whole surface, and in each diagram of a part that has all of the
// ball, too. A sheet is one of the surface alone: all know it that have the ball for which it was made.

#include <algorithm>
#include <limits>
#include <vector>

#include "fpo/domain.h"
#include "fpo/tiles/tile_guard.h"
#include "geom/dual/known_cell.h"

namespace fpo {

class KnownCells {
 public:
  /// Nothing is known yet.
  explicit KnownCells(std::size_t num_samples) : cells_(num_samples) {}

  /// After a round: of a sample of the guard's tile, by the tile's diagram. Each sample once, any thread.
  void set(SiteId x, const geom::RestrictedDual& dual, SiteId here, const TileGuard& guard);
  /// Of a sample of the whole surface, by the diagram of it.
  void set(SiteId x, const geom::RestrictedDual& whole);
  /// The same: a bound of the power in a tile. One thread at a time.
  void raise_power(double power) { power_ = std::max(power_, power); }

  /// The round is over: what the guard's tile may use in the next one. Cells of samples in other tiles are
  /// not looked at: those are not moved.
  geom::KnownCell of(SiteId x, const geom::WeightedPoint3& site, const TileGuard& guard) const;
  /// The same of the whole surface.
  geom::KnownCell of(SiteId x, const geom::WeightedPoint3& site) const;

 private:
  bool is_known(SiteId x, const geom::WeightedPoint3& site, double room) const;

  struct Cell {
    geom::KnownCell known;
    double room = -1;  ///< the radius of the largest ball about the site in the tile
  };
  std::vector<Cell> cells_;
  double power_ = -std::numeric_limits<double>::infinity();
};

}  // namespace fpo
