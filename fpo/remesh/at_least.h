#pragma once
// As many samples as a remesh needs to be of its input's topological type.

#include "fpo/remesh/pipeline.h"

namespace fpo {

struct AtLeastResult {
  RemeshResult remesh;
  std::size_t runs = 1;
  std::size_t not_enough = 0;  ///< the most samples with which the type was wrong; 0: none was tried
};

/// Remeshes with options.num_samples; if the result is not a 2-manifold of the input's type, with half as
/// many more, and so on, up to `most_factor` times as many; then with numbers between the last two, until
/// these differ by less than a tenth. The result is that of the fewest samples that did, or if none did of
/// the most. Fewer than 64 may be too few for any triangle: then what remesh() says of them counts only if it
/// says so of more, too.
/// options.tile_samples is kept. An interruption ends it with the best so far.
AtLeastResult remesh_at_least(const geom::TriMesh& input, const RemeshOptions& options,
                              double most_factor = 64);

}  // namespace fpo
