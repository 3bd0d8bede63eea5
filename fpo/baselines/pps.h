#pragma once
// Parallel Poisson-disk sampling [BWWM10]: J. Bowers, R. Wang, L.-Y. Wei, D. Maletz, Parallel Poisson disk
// sampling with spectrum analysis on surfaces, 2010. PPS in the paper's tables.
//
//    +--+--+--+--+     A cube of side r / sqrt 3 has the diagonal r: it holds at most one sample. Cubes whose
//    |a |b |c |a |     coordinates agree modulo 3 make a phase group. Two of them (a, a) are at least
//    +--+--+--+--+     2 r / sqrt 3 > r apart, so darts in them never meet each other's disks: all cubes of a
//     <2r/sqrt 3>      group are worked on at the same time, the groups one after the other.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// A dense cloud of random candidates with density h^-2, two hundred for each sample wanted, is sorted into
/// the cubes. In trial k each cube without a sample puts forward its k-th candidate, which is accepted if it
/// is in no disk; the phase groups come in a random order that the seed fixes, drawn anew for each trial.
/// Disks have radius c h; c is searched for the number of samples (search_radius in disks.h). All candidates
/// are covered in the end; what the cloud leaves uncovered between them stays so. Adaptive: a candidate of
/// radius in [r, 2 r), r = 2^level times the least, is in a cube of side r / sqrt 3 of its own level, and
/// groups are of one level and modulo 5, for 4 r / sqrt 3 > 2 r. Distances are straight ones, where the
/// publication also has an approximation of geodesic ones. The groups are worked on by task.threads threads;
/// which candidate is accepted does not depend on their number, nor on their timing: none of a phase looks
/// at another of it. O(n log n) a radius. Deterministic. Throws geom::InputError like random_samples().
BaselineResult parallel_poisson_disks(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
