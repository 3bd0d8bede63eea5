#pragma once
// Maximal Poisson-disk sampling [YW13]: D.-M. Yan, P. Wonka, Gap processing for adaptive maximal Poisson-disk
// sampling, 2013. MPS in the paper's tables.
//
// Darts are thrown at the surface and stay where they hit no disk. Then come the gaps: a fragment of the
// restricted power diagram of the disks, a convex polygon, has a gap iff its owner's disk does not cover it,
// and, disks being convex, iff it does not cover a corner. Darts at the gaps alone fill them until there is
// none: then the disks cover the surface, with certainty.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Disks of radius c h; c is searched for the number of samples (search_radius in disks.h). No sample is in
/// the disk of an earlier one (with uniform sizing: any two are at least c h apart), and the disks cover the
/// surface, up to rounding. Distances are straight ones. O(n log n + F) expected a radius. Deterministic.
/// Throws geom::InputError like random_samples().
BaselineResult maximal_poisson_disks(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
