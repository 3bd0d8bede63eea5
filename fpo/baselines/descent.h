#pragma once
// Descent of an energy of all samples together, which stay on the surface: by L-BFGS (lbfgs.h), as Y. Liu et
// al. do it for centroidal Voronoi tessellations (On centroidal Voronoi tessellation - energy smoothness and
// fast computation, 2009). Shared by CVT and variational blue noise.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "fpo/baselines/baseline.h"

namespace fpo {

/// Three numbers a sample, x, y, z after each other.
struct EnergyAt {
  double energy = 0;
  Eigen::VectorXd gradient;
  Eigen::VectorXd scale;  ///< the inverse of the Hessian's diagonal, about; not negative
};

using SampleEnergy = std::function<EnergyAt(const std::vector<SurfaceSample>&)>;

struct DescentOptions {
  int plain_steps = 0;          ///< along -scale * gradient, before L-BFGS begins
  std::size_t memory_size = 7;  ///< of L-BFGS
};

/// From first_samples() on at most options.max_iterations steps of both kinds. The gradient counts without
/// its part along the surface's normal, and not at all where samples are fixed. Steps go half as far again
/// and again until the energy sinks enough (Armijo's condition), so it never grows; samples are put back
/// on the surface after each, and none moves by more than h / 2. If no step of L-BFGS lowers the energy, a
/// plain one is tried; if that fails too, the descent ends. An evaluation and a little more an iteration.
/// Deterministic if the energy is. Throws geom::InputError like random_samples().
BaselineResult descend(const BaselineTask& task, const OptimizeOptions& options, const SampleEnergy& energy,
                       const DescentOptions& descent);

}  // namespace fpo
