#pragma once
// Holes and other closed curves that are much shorter than three wanted lengths: three samples on them are
// much nearer to each other than samples elsewhere, and need smaller triangles around.

#include <limits>

#include "fpo/features/feature_samples.h"

namespace fpo {

struct SmallLoops {
  std::size_t loops = 0;  ///< closed chains, or two between the same corners, with edges < .6 wanted lengths
  Sizing sizing;          ///< lowered around these, by at most what most_scale permits
};

struct SmallLoopOptions {
  double gradation;   ///< of the lengths around
  double most_scale;  ///< elsewhere edges need not be longer than this times what was wanted
  /// Loops of more edges are left as they are. Lengths that follow the shape are short there by themselves; a
  /// loop of three samples has fewer than they ask for, since it cannot do with fewer.
  std::size_t most_edges = std::numeric_limits<std::size_t>::max();
};

/// The sizing with the wanted length lowered to the chain's edges around each such loop, smallest demand
/// first, as long as that can be spared elsewhere. The given sizing if there is no such loop. O(chains and
/// loops).
SmallLoops make_room_for_small_loops(const geom::TriMesh& mesh, const SharedSizing& shared, std::size_t n,
                                     const SmallLoopOptions& options);

}  // namespace fpo
