#pragma once
// Shortest edge removal (paper, section 4.3): a quick way from random samples to a fair set, from which the
// local variant of farthest point optimization needs no long moves.

#include <atomic>
#include <cstddef>
#include <functional>

#include "fpo/domain.h"

namespace fpo {

struct ShortestEdgeOptions {
  std::size_t max_moves_per_sample = 10;           ///< a guard; about 0.6 are used
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each move
  std::function<void(std::size_t move)> on_move;   ///< called before each move, counted from 0
};

struct ShortestEdgeResult {
  std::size_t moves = 0;
  bool converged = false;  ///< the samples with the shortest edges no longer leave their holes
};

/// Again and again moves an end of the shortest edge (in units of the spacing wanted there) to the farthest
/// point, until that is, for some time, in the hole that the sample itself has left. Among equal edges the
/// sample of smallest id moves; fixed ones never do. O(log n) expected a move; deterministic. The domain must
/// know neighbours (Domain::neighbours).
ShortestEdgeResult remove_shortest_edges(Domain& domain, const ShortestEdgeOptions& options = {});

}  // namespace fpo
