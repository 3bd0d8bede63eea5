#pragma once
// The samples of a remesh, distributed by the method that is wanted, with their diagram.

#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Those of the remesh, for its sizing and the samples that stay.
SurfaceOptions surface_options(const SharedSizing& shared, const RemeshOptions& options);

/// By the method wanted. `start`: its samples are those to begin with; null: others. What is told of the
/// optimization is noted in the result.
SurfaceDomain distributed_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                  const RemeshResult* start, const RemeshOptions& options,
                                  RemeshResult& result);

/// Those that this leads to from the beginning, as they were found before.
SurfaceDomain same_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                           const RemeshResult& before, const RemeshOptions& options, RemeshResult& result);

/// What is left to do where the samples of a coarser surface are brought to: the features are its own, and
/// may have pushed them aside.
SurfaceDomain settled_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                              const RemeshResult& coarse, const RemeshOptions& options, RemeshResult& result);

}  // namespace fpo
