#pragma once
// Triangles far from the surface, mended like those with bad angles: not in the paper, whose samples alone
// decide how far the remesh is from the surface.

#include <atomic>
#include <cstddef>
#include <limits>

#include "fpo/remesh/angles.h"
#include "fpo/remesh/flaws.h"

namespace fpo {

struct FidelityOptions {
  /// A triangle is far if its distance is more than this share of the largest one at the start: where the
  /// surface is folded or narrow in comparison with the spacing.
  double share_of_largest = 0.7;
  double enough_delta = 0.915;  ///< with uniform sizing delta is not made smaller than this
  bool keep_spacing = false;    ///< the same with lengths that differ, each distance in its own
  /// At most so many moves, give or take one triangle's, and never more than about ten iterations' worth.
  std::size_t most_moves = std::numeric_limits<std::size_t>::max();
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each triangle
};

/// Distances in the units of the surface: from it of the RRT's triangles, at the middles of their edges and
/// at their own. Less than the Hausdorff distance, but large where that is.
struct FidelityResult {
  double largest_before = 0, largest_after = 0;
  std::size_t tried = 0, mended = 0;
};

/// Takes the farthest triangle first: resamples around it, or puts a corner of it to where the surface is
/// far. What does not lessen the sum over all far triangles of the square of what they exceed the bound by,
/// in units of it, is undone, and so is what makes angles worse (`angles`) or, with uniform sizing, delta
/// smaller and not enough. A round ends when eight in a row cannot be mended; there is another one if
/// something was. The number of samples stays; fixed ones stay where they are. Deterministic. Some closest
/// points a triangle, and about as many moves as ten iterations of the optimization, at most.
FidelityResult improve_fidelity(SurfaceDomain& domain, const AngleOptions& angles,
                                const FidelityOptions& options = {});

}  // namespace fpo
