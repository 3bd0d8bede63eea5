#pragma once
// Farthest point optimization (paper, section 3) with the distance along the edges of a surface in place of
// the one through space, and its vertices in place of all locations: sheets and sides of tubes that are near
// each other do not know of one another, whatever the number of samples.

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include "fpo/remesh/sampled_surface.h"

namespace fpo {

struct FarthestVerticesOptions {
  std::size_t first = 0;  ///< samples before this one stay
  int iterations = 10;
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each move
};

/// Each sample in turn is removed and put at the vertex, on no curve, that is then farthest from all samples
/// in units of the length wanted there (`wanted`: by vertices, positive), which may be where it was. Parts
/// without a sample are farther than any that have one. Ends where no sample moves. Those that are elsewhere
/// in the end, ascending. Deterministic. A move costs O(R log V), R the vertices of the cells around.
std::vector<geom::SiteId> move_to_farthest_vertices(SampledSurface& surface,
                                                    const geom::Table<geom::VertexId, double>& wanted,
                                                    const FarthestVerticesOptions& options);

}  // namespace fpo
