#pragma once
// Input of which no remesh can be made, seen before the work: it would take long and end in a ruin.

#include "geom/mesh/trimesh.h"

namespace fpo {

/// Refuses, by InputError, a surface in more parts than there are samples; one that is mostly single facets
/// without a neighbour that get fewer than 30 samples each; and one of which more than 16 sheets lie within
/// the spacing (layers.h): stacks of plates, facets at random. O(F log F + n).
void refuse_crowd(const geom::TriMesh& surface, std::size_t num_samples);

}  // namespace fpo
