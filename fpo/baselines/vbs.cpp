#include "fpo/baselines/vbs.h"

#include <algorithm>
#include <cmath>

#include "fpo/baselines/capacities.h"
#include "fpo/baselines/descent.h"

namespace fpo {

using Eigen::VectorXd;

namespace {

/// For a hexagon of area A a capacity's part of the Hessian's diagonal is about .58 A, the CVT energy's 2 A.
constexpr double curvature_of_capacity = 0.58;

double mean_capacity(const Capacities::Diagram& diagram, std::size_t num_fixed) {
  const std::size_t n = diagram.cells.size();
  double sum = 0;
  for (std::size_t i = num_fixed; i < n; ++i) sum += diagram.cells[SiteId(i)].capacity;
  return sum / static_cast<double>(std::max<std::size_t>(n - num_fixed, 1));
}

double variation(const Capacities::Diagram& diagram, std::size_t num_fixed) {
  const double mean = mean_capacity(diagram, num_fixed);
  const std::size_t n = diagram.cells.size();
  double squares = 0;
  for (std::size_t i = num_fixed; i < n; ++i) {
    const double capacity = diagram.cells[SiteId(i)].capacity;
    squares += (capacity - mean) * (capacity - mean);
  }
  if (n == num_fixed) return 0;
  return std::sqrt(squares / static_cast<double>(n - num_fixed)) / mean;
}

EnergyAt energy_of(const Capacities::Diagram& diagram, std::size_t num_fixed) {
  const std::size_t n = diagram.cells.size();
  const auto at = [](SiteId i) { return static_cast<Eigen::Index>(3 * i.index()); };
  const double mean = mean_capacity(diagram, num_fixed);
  const auto capacity = [&](SiteId i) { return i.index() < num_fixed ? mean : diagram.cells[i].capacity; };
  EnergyAt result{0, VectorXd::Zero(at(SiteId(n))), VectorXd::Zero(at(SiteId(n)))};
  for (std::size_t i = 0; i < n; ++i) {
    const CellCapacity& cell = diagram.cells[SiteId(i)];
    const double excess = capacity(SiteId(i)) - mean;
    result.energy += cell.second + capacity_weight * excess * excess;
    if (!(cell.mass > 0)) continue;
    result.gradient.segment<3>(at(SiteId(i))) = -2 * cell.first;
    result.scale.segment<3>(at(SiteId(i)))
        .setConstant(1 / ((2 + curvature_of_capacity * capacity_weight) * cell.mass));
  }
  for (const CellWall& wall : diagram.walls)
    result.gradient.segment<3>(at(wall.owner)) +=
        2 * capacity_weight * (capacity(wall.owner) - capacity(wall.other)) * wall.gain;
  return result;
}

}  // namespace

BaselineResult variational_blue_noise(const BaselineTask& task, const OptimizeOptions& options) {
  Capacities capacities(task.surface, task.sizing, hexagonal_spacing(task.surface.area(), task.num_samples),
                        task.threads);
  BaselineResult result = descend(task, options,
                                  [&](const std::vector<SurfaceSample>& samples) {
                                    return energy_of(capacities.of(samples), task.fixed.size());
                                  },
                                  {});
  result.reached.push_back({"capacity_cv", variation(capacities.of(result.samples), task.fixed.size())});
  return result;
}

}  // namespace fpo
