#pragma once
// Centroidal Voronoi tessellation [YLL*09]: D.-M. Yan, B. Levy, Y. Liu, F. Sun, W. Wang, Isotropic remeshing
// with fast and exact computation of restricted Voronoi diagram, 2009; minimized as by Y. Liu et al., On
// centroidal Voronoi tessellation - energy smoothness and fast computation, 2009. CVT in the paper's tables.

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Minimizes the energy F(X) = sum over i of the integral of d(x) |x - x_i|^2 over the restricted Voronoi
/// cell of x_i, with x_i on the surface and density d = h^-4 (1 if the sizing is uniform), which makes
/// cell diameters proportional to h. The gradient is 2 m_i (x_i - c_i), m_i the cell's mass and c_i its
/// centroid, without its part along the surface's normal. From first_samples() on five of Lloyd's steps,
/// x_i to c_i, then L-BFGS with seven steps of memory, the diagonal 1 / (2 m_i) as first approximation and
/// backtracking; samples are put back on the surface after each step. options.max_iterations counts both
/// kinds. The energy never grows. Ends early if no step lowers it any more. O(n log n + fragments) an
/// iteration. Deterministic. Throws geom::InputError like random_samples().
BaselineResult centroidal_tessellation(const BaselineTask& task, const OptimizeOptions& options);

}  // namespace fpo
