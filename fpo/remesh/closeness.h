#pragma once
// The remesh brought closer to the surface, both ways: not in the paper, whose samples alone decide how far
// it is from it.

#include <atomic>
#include <cstddef>
#include <limits>

#include "fpo/remesh/angles.h"
#include "fpo/remesh/remembered_samples.h"

namespace fpo {

struct ClosenessOptions {
  /// A round brings all distances below this share of the largest, at first; after one that fails the next
  /// asks for half as much less (.85, .925). At least one round.
  double share_of_largest = 0.7;
  int rounds = 8;
  double enough_delta = 0.88;  ///< with uniform sizing delta is not made smaller than this
  /// A share of the triangles: if more than that are beyond the bound, the largest distance is one of many,
  /// and less is asked for.
  double most_far = 1;
  std::size_t most_moves = std::numeric_limits<std::size_t>::max();  ///< give or take one triangle's
  std::size_t most_looks = most_moves;       ///< at edges of the surface (surface_above.h), likewise
  const RememberedSamples* older = nullptr;  ///< of the domain, if there are some: spares memory
  int threads = 1;                           ///< that find distances of all triangles; no result changes
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each triangle
};

/// Distances in the units of the surface: from it of the RRT's triangles (triangle_distances.h), and of what
/// belongs to these from them (surface_above.h).
struct ClosenessResult {
  double largest_before = 0, largest_after = 0;
  std::size_t tried = 0, mended = 0;  ///< triangles
};

/// Takes the farthest triangle first. Of its corners and those around it, the one is nudged that has a
/// place, around it or on the way to the far point, where the triangles that are too far are less so and
/// as few samples as possible come too close to others; else the samples are resampled as in fidelity.h.
/// Then those that are too close are pushed apart (spreading.h); where that fails, all is undone, and so
/// is what makes angles worse, and in the end everything if the largest distance is hardly smaller. The
/// number of samples stays; fixed ones stay where they are. Deterministic. Cost: a second for 2000
/// samples, where cells have a dozen facets.
ClosenessResult come_closer(SurfaceDomain& domain, const AngleOptions& angles,
                            const ClosenessOptions& options = {});

}  // namespace fpo
