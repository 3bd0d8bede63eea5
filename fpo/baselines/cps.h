#pragma once
// Constrained Poisson-disk sampling [CCS12]: M. Corsini, P. Cignoni, R. Scopigno, Efficient and flexible
// sampling with blue noise properties of triangular meshes, 2012. CPS in the paper's tables.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// A dense pool of Monte-Carlo samples with density h^-2, fifteen for each wanted; then again and again one
/// of those left is picked at random and all others in its disk are eliminated. The disk has radius c h; c is
/// searched for the number of samples (search_radius in disks.h). What the pool leaves uncovered stays so.
/// Picks are uniform over the samples left, where the publication first picks one of the cells of a grid.
/// Distances are straight ones.
/// O(n log n) a radius. Deterministic. Throws geom::InputError like random_samples().
BaselineResult constrained_poisson_disks(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
