#pragma once
// Variational blue noise sampling [CYC*12]: Z. Chen, Z. Yuan, Y.-K. Choi, L. Liu, W. Wang, Variational blue
// noise sampling, 2012. VBS in the paper's tables.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Weight of the capacities against the CVT energy. Both terms are squares of areas times d^2, so it has no
/// unit, and a regular hexagon of area A has 5 sqrt(3) / 54 A^2 = .160 A^2 of the first term. The
/// publication's own value is not known here; with 10 the sets become nearly as regular as those of CVT
/// (Q_avg .90 on eight 1700), with 1000 L-BFGS does not come near a minimum in 100 iterations.
inline constexpr double capacity_weight = 100;

/// Minimizes E(X) = sum over i of the integral of d^2 |x - x_i|^2 over V_i
///               + capacity_weight * sum over i of (m_i - m)^2,
/// V_i the restricted Voronoi cell of x_i, m_i the integral of d over it (its capacity), m the mean of all
/// m_i, and d = h^-2, up to a factor, the wanted density of samples (1 if the sizing is uniform). The
/// gradient is
///   dE/dx_i = -2 integral of d^2 (x - x_i) + 2 capacity_weight * sum over walls (i, j) of (m_i - m_j) g_ij
/// with g_ij as in capacities.h. Samples that are fixed have no part in the second term (m_i counts as m, the
/// mean of the others): on a border they have half a cell, and who asked for a whole one would drive the
/// others away. Both terms are least for regular hexagons, but capacities are equal for many sets that are
/// not regular, and descent ends at one of these. Steps are those of L-BFGS (descent.h) from first_samples()
/// on; options.max_iterations counts them. Reached "capacity_cv": the standard deviation of the capacities
/// over their mean, of samples that are not fixed. O(n log n + fragments) an iteration. Deterministic. Throws
/// geom::InputError like random_samples().
BaselineResult variational_blue_noise(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
