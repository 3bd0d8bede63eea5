#pragma once
// Input of which no remesh can be made, seen before the work: it would take long and end in a ruin.

#include "geom/mesh/trimesh.h"

namespace fpo {

/// Refuses, by InputError, a surface in more parts than there are samples; one that is mostly single facets
/// without a neighbour that get fewer than 30 samples each; and one of which more than 16 sheets lie within
/// the spacing (layers.h): stacks of plates, facets at random. O(F log F + n).
void refuse_crowd(const geom::TriMesh& surface, std::size_t num_samples);

/// Refuses, by InputError, a surface most of which is thinner than the spacing, so that samples lie one after
/// the other and not side by side: on more than half of it less than .6 of a disk of that radius (with
/// borders, on which samples face each other, .15) is surface. Such is a tube that is less around than the
/// spacing, or a strip of a quarter of it. Nothing is refused that has less than 16 samples. O(F log F + n).
void refuse_thread(const geom::TriMesh& surface, std::size_t num_samples);

}  // namespace fpo
