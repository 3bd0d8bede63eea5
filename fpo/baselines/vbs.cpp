#include "fpo/baselines/vbs.h"

#include <cmath>

#include "fpo/baselines/capacities.h"
#include "fpo/baselines/descent.h"

namespace fpo {

using Eigen::VectorXd;

namespace {

/// For a hexagon of area A a capacity's part of the Hessian's diagonal is about .58 A, the CVT energy's 2 A.
constexpr double curvature_of_capacity = 0.58;

double mean_capacity(const Capacities::Diagram& diagram) {
  double sum = 0;
  for (const CellCapacity& cell : diagram.cells) sum += cell.capacity;
  return sum / static_cast<double>(diagram.cells.size());
}

double variation(const Capacities::Diagram& diagram) {
  const double mean = mean_capacity(diagram);
  double squares = 0;
  for (const CellCapacity& cell : diagram.cells) squares += (cell.capacity - mean) * (cell.capacity - mean);
  return std::sqrt(squares / static_cast<double>(diagram.cells.size())) / mean;
}

EnergyAt energy_of(const Capacities::Diagram& diagram) {
  const std::size_t n = diagram.cells.size();
  const auto at = [](SiteId i) { return static_cast<Eigen::Index>(3 * i.index()); };
  const double mean = mean_capacity(diagram);
  EnergyAt result{0, VectorXd::Zero(at(SiteId(n))), VectorXd::Zero(at(SiteId(n)))};
  for (std::size_t i = 0; i < n; ++i) {
    const CellCapacity& cell = diagram.cells[SiteId(i)];
    const double excess = cell.capacity - mean;
    result.energy += cell.second + capacity_weight * excess * excess;
    if (!(cell.mass > 0)) continue;
    result.gradient.segment<3>(at(SiteId(i))) = -2 * cell.first;
    result.scale.segment<3>(at(SiteId(i)))
        .setConstant(1 / ((2 + curvature_of_capacity * capacity_weight) * cell.mass));
  }
  for (const CellWall& wall : diagram.walls)
    result.gradient.segment<3>(at(wall.owner)) +=
        2 * capacity_weight * (diagram.cells[wall.owner].capacity - diagram.cells[wall.other].capacity) *
        wall.gain;
  return result;
}

}  // namespace

BaselineResult variational_blue_noise(const BaselineTask& task, const OptimizeOptions& options) {
  Capacities capacities(task.surface, task.sizing, hexagonal_spacing(task.surface.area(), task.num_samples),
                        task.threads);
  BaselineResult result = descend(
      task, options,
      [&](const std::vector<SurfaceSample>& samples) { return energy_of(capacities.of(samples)); }, {});
  result.reached.push_back({"capacity_cv", variation(capacities.of(result.samples))});
  return result;
}

}  // namespace fpo
