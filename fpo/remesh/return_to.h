#pragma once
// A remesh of a surface that was split is one of that surface.

#include <memory>

#include "fpo/remesh/pipeline.h"
#include "fpo/surface/split_facets.h"

namespace fpo {

/// Its samples and cells become those of the facets that `split` has parts of; so do those of what there is
/// instead (RemeshResult::last_resort). O(samples + cells).
void return_to(const SplitSurface& split, RemeshResult& result);

/// The same of a surface with edges cut: it has no sizes at cuts, and its features stay those of `cut`.
void return_to(const geom::TriMesh& surface, std::shared_ptr<const SplitSurface> cut, RemeshResult& result);

}  // namespace fpo
