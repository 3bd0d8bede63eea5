#pragma once
// The number of samples that keeps all features, for the options of a remesh.

#include "fpo/features/samples_for_features.h"
#include "fpo/remesh/pipeline.h"

namespace fpo {

/// Of the features that are seen with the options, with corners as small as they are in the input. 0 if that
/// is none or they are noise, where none are kept however many samples there are, and for methods that do not
/// move samples off curves.
FeatureBound feature_bound(const geom::TriMesh& surface, const RemeshOptions& options);

}  // namespace fpo
