#pragma once
// Hierarchical Poisson-disk sampling [MIPS14]: E. Medeiros, L. Ingrid, S. Pesco, C. Silva, Fast adaptive blue
// noise on polygonal surfaces, 2014. HPS in the paper's tables.
//
//          /\           The surface is a list of active triangles. One is taken from it with a probability
//         /  \          proportional to its area over h^2, and a dart is thrown in it, which becomes a sample
//        /____\         if it is in no disk. Then the triangle is divided in four. What one disk covers is
//       / \  / \        culled: three corners in a disk means all of the triangle, for disks are convex. The
//      /___\/___\       rest is active. So darts go where there is room, ever finer, until there is none.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Disks of radius c h; c is searched for the number of samples (search_radius in disks.h). No sample is in
/// the disk of an earlier one. Triangles smaller than a 2^-20th of their disks are not divided any more: they
/// get a sample in the middle if that is free, and else are given up; Reached "uncovered_triangles" counts
/// those given up, so that the disks cover the surface up to them and rounding. Distances are straight ones.
/// Triangles in groups of about equal area make picking one O(1) (D. Cline et al., Dart throwing on surfaces,
/// 2009). O(n log n) expected a radius. Deterministic. Throws geom::InputError like random_samples().
BaselineResult hierarchical_poisson_disks(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
