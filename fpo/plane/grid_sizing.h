#pragma once
// A sizing function on the torus kept as values on a grid.

#include <cstddef>
#include <memory>
#include <vector>

#include "fpo/plane/plane_sizing.h"

namespace fpo {

/// Values at the centers of equal cells that cover the torus once, row by row upwards.
struct PeriodicGrid {
  std::size_t width = 0, height = 0;
  std::vector<double> value;
  double& at(std::size_t i, std::size_t j) { return value[j * width + i]; }
  double at(std::size_t i, std::size_t j) const { return value[j * width + i]; }
};

/// The sizing with these values or smaller ones, bilinear between the cells' centers: rho is lowered until
/// the wanted edge length h of num_samples samples grows by at most `gradation` times the distance, measured
/// along steps to the eight neighbours of a cell. Positive values only. O(cells) a sweep, a few sweeps.
std::unique_ptr<PlaneSizing> grid_sizing(const PeriodicGrid& rho, const geom::FlatTorus& torus,
                                         std::size_t num_samples, double gradation);

}  // namespace fpo
