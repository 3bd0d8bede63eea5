#pragma once
// A remesh of a surface that was split is one of that surface.

#include "fpo/remesh/pipeline.h"
#include "fpo/surface/split_facets.h"

namespace fpo {

/// Its samples and cells become those of the facets that `split` has parts of; so do those of what there is
/// instead (RemeshResult::last_resort). O(samples + cells).
void return_to(const SplitSurface& split, RemeshResult& result);

}  // namespace fpo
