#include "fpo/baselines/cvt.h"

#include "fpo/baselines/cell_moments.h"
#include "fpo/baselines/descent.h"

namespace fpo {

using Eigen::VectorXd;

namespace {

constexpr int lloyd_steps = 5;

}  // namespace

BaselineResult centroidal_tessellation(const BaselineTask& task, const OptimizeOptions& options) {
  VoronoiMoments moments(task.surface, task.sizing, hexagonal_spacing(task.surface.area(), task.num_samples),
                         task.threads);
  const auto energy = [&](const std::vector<SurfaceSample>& samples) {
    const geom::Table<SiteId, CellMoments>& cells = moments.of(samples);
    const auto size = static_cast<Eigen::Index>(3 * samples.size());
    EnergyAt result{0, VectorXd::Zero(size), VectorXd::Zero(size)};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const CellMoments& cell = cells[SiteId(i)];
      result.energy += cell.second;
      if (!(cell.mass > 0)) continue;
      result.gradient.segment<3>(static_cast<Eigen::Index>(3 * i)) = -2 * cell.first;
      result.scale.segment<3>(static_cast<Eigen::Index>(3 * i)).setConstant(1 / (2 * cell.mass));
    }
    return result;
  };
  return descend(task, options, energy, {.plain_steps = lloyd_steps});
}

}  // namespace fpo
