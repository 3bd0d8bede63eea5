#pragma once
// Holes and other closed curves that are much shorter than three wanted lengths: three samples on them are
// much nearer to each other than samples elsewhere, and need smaller triangles around.

#include "fpo/features/feature_samples.h"

namespace fpo {

struct SmallLoops {
  std::size_t loops = 0;  ///< closed chains, or two between the same corners, with edges < .6 wanted lengths
  Sizing sizing;          ///< lowered around these, by at most what `most_scale` permits
};

/// The sizing with the wanted length lowered to the chain's edges around each such loop, smallest demand
/// first, as long as edges elsewhere need not be longer than `most_scale` times what was wanted. The given
/// sizing if there is no such loop. O(chains + loops).
SmallLoops make_room_for_small_loops(const geom::TriMesh& mesh, const SharedSizing& shared, std::size_t n,
                                     double gradation, double most_scale);

}  // namespace fpo
