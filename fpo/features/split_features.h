#pragma once
// The features of a surface on the same one with smaller facets (split_facets.h).

#include "fpo/features/features.h"
#include "fpo/surface/split_facets.h"

namespace fpo {

/// Each edge of a curve as the edges that it was split to. Corners and curves are as many, and in the same
/// order. O(facets of `split` + edges of curves log of these).
Features split_features(const Features& features, const geom::TriMesh& mesh, const SplitSurface& split);

}  // namespace fpo
