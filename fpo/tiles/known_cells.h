#pragma once
// What a round of tiles finds out about the cells of its samples, for the tiles of the next round and for the
// whole surface in the end; and what is known there before the first round.
//
// Let D be the diagram of all samples on the whole surface as they are between two rounds, and P a bound of
// the power everywhere in it. All that a site owns in D is within sqrt(P + w) of it: in its ball. What is
// told of a cell (it is connected, with one border, through all of its circles: fast_way.h) is a matter of
// the cell alone: true in D if it is in a diagram with the same cell, and the other way round.
//
//   - A tile that begins has all facets that meet its box T and all samples that own anything of these
//     (tile_domain.h), so each location of T has the owner there that it has in D. A cell whose ball is in T
//     is that of D.
//   - A tile that ends: the others have changed owners in their own boxes only (tile_guard.h), so its
//     locations of T, again, have the owners that they have in D; and as each location is in some T, P is
//     the largest reach in any tile's diagram. A cell whose ball is in T is that of D.
//   - The whole surface has D itself, so all balls.
//
// So a cell is told by one of these to another if its ball is in both. A sheet is a matter of the surface
// alone: all know it that have the ball for which it was made.
//
// The circles of a cell are its corners, so they are told with it: a diagram is then put together from what
// is known, and only the surface near other cells is divided (geom/dual/known_circles.h), by the bound P. It
// holds in a tile with M >= P (tile_domain.h): that has the owners of D on all of its facets. Of more than
// most_with_circles samples circles would be much of the memory of a run.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "fpo/domain.h"
#include "fpo/surface/weighted_samples.h"
#include "fpo/tiles/tile_guard.h"
#include "geom/dual/known_cell.h"

namespace fpo {

class KnownCells {
 public:
  static constexpr std::size_t most_with_circles = 1U << 18U;  ///< some 170 bytes each

  /// Nothing is known yet. `num_tiles`: who will tell.
  KnownCells(std::size_t num_samples, std::size_t num_tiles);
  /// What the diagram of the whole surface knows, at any time.
  explicit KnownCells(const geom::RestrictedDual& whole);

  /// After a round: of a sample of the guard's tile, by the tile's diagram. Each sample once, any thread.
  void set(SiteId x, const geom::RestrictedDual& dual, SiteId here, const TileGuard& guard);
  /// The same of a tile: circles that touch regular cells of its samples, each such circle at least once, in
  /// the ids of the whole.
  void set_circles(std::size_t tile, std::vector<geom::EmptyCircle> circles) {
    if (has_circles()) told_[tile] = std::move(circles);
  }
  /// The same: a bound of the power in a tile. One thread at a time.
  void raise_power(double power) { power_ = std::max(power_, power); }
  /// All have told.
  void end_round();

  /// The round is over: what the guard's tile may use in the next one. Cells of samples in other tiles are
  /// not looked at: those are not moved.
  geom::KnownCell of(SiteId x, const geom::WeightedPoint3& site, const TileGuard& guard) const;
  /// What the whole surface may use: of all samples.
  std::vector<geom::KnownCell> of_all(const WeightedSamples& samples) const;
  /// Bounds of the power in their cells; empty if no circle is told.
  std::span<const double> reaches() const { return reaches_; }
  /// Gives back their memory: from now on only circles are known.
  void forget_cells() { std::vector<Cell>().swap(cells_); }
  /// A bound of the power anywhere.
  double power() const { return power_; }
  /// The circles that were told, those of all regular cells among them; the places there of those that touch
  /// one.
  std::span<const geom::EmptyCircle> circles() const { return circles_; }
  std::span<const std::uint32_t> circles_of(SiteId x) const {
    if (circles_.empty()) return {};
    return std::span(of_site_).subspan(begin_[x.index()], begin_[x.index() + 1] - begin_[x.index()]);
  }

 private:
  bool is_known(SiteId x, double weight, double room) const;
  bool is_any_regular(const geom::EmptyCircle& circle) const;
  bool has_circles() const { return !reaches_.empty(); }

  struct Cell {
    geom::KnownCell known;
    double room = -1;  ///< the radius of the largest ball about the site in the tile
  };
  std::vector<Cell> cells_;
  std::vector<double> reaches_;                       ///< none if no circle is told
  std::vector<std::vector<geom::EmptyCircle>> told_;  ///< by each tile
  std::vector<geom::EmptyCircle> circles_;
  std::vector<std::uint32_t> begin_, of_site_;  ///< those of each sample
  double power_ = -std::numeric_limits<double>::infinity();
};

}  // namespace fpo
