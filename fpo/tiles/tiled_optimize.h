#pragma once
// Farthest point optimization (Algorithm 1) of many samples on a surface by several threads, and with the
// memory of some thousand samples a thread: in rounds, each of which cuts space elsewhere into tiles
// (tiles.h) and moves the samples of each tile some times, independently of the other tiles (tile_domain.h).
//
// A sample near a cut cannot be moved in that round. It is moved the more often in the next one, whose cuts
// keep away from those who have waited longest, and in the end on the whole surface, so that every sample has
// been removed and inserted once an iteration. "The largest empty circle" of Scope::global is the largest one
// well inside the sample's tile, but for three iterations on the whole surface that come first and even out
// the density at large; Scope::two_ring is the same as without tiles. The result depends on the samples, the
// seed and the options, not on the number of threads.

#include <span>
#include <vector>

#include "fpo/optimize.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

struct TileOptions {
  std::size_t most_samples = 3000;  ///< in a tile
  int sweeps = 10;                  ///< iterations a round; the first rounds have fewer
  int threads = 1;
};

/// What optimize_in_tiles() works on. References are kept during the call; the domain keeps them longer.
struct SurfaceTask {
  const geom::TriMesh& mesh;
  const Sizing& sizing;
  std::vector<SurfaceSample> samples;
  const SurfaceOptions& surface;
};

/// The domain of the samples after the optimization. Reports come once a round (at first once an iteration,
/// if these are on the whole surface), with delta and mean delta by distances in space: until the last report
/// those of near sheets count even if the samples have weights. Callbacks come from any thread, one at a
/// time. Orders other than in_turn are drawn for each tile anew. Throws geom::Bug with round, tile and move
/// in its text.
SurfaceDomain optimize_in_tiles(SurfaceTask task, const TileOptions& tiles, const OptimizeOptions& options,
                                OptimizeResult& result);

}  // namespace fpo
