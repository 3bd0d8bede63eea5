#include "fpo/baselines/first_samples.h"

#include <algorithm>

#include "fpo/baselines/disks.h"
#include "fpo/surface/initial_samples.h"

namespace fpo {
namespace {

constexpr double room = 0.7;  // of .777 that random disks can have
constexpr std::size_t draws_per_sample = 8;

/// Among samples that are fixed. These part the surface, and nobody crosses a crease: so every part gets its
/// share, which random samples would miss by the root of their number.
std::vector<SurfaceSample> spread_samples(const BaselineTask& task) {
  Disks fixed(task.sizing, room), samples(task.sizing, room);
  for (const SurfaceSample& x : task.fixed) fixed.add(x), samples.add(x);
  const std::size_t draws =
      std::max(task.num_inner(), std::min(max_samples, draws_per_sample * task.num_inner()));
  std::vector<SurfaceSample> near_others, near_fixed;
  for (const SurfaceSample& x : random_samples(task.surface, task.sizing, draws, task.seed)) {
    if (samples.is_free(x.position))
      samples.add(x);
    else
      (fixed.is_free(x.position) ? near_others : near_fixed).push_back(x);
    if (samples.samples().size() == task.num_samples) break;
  }
  std::vector<SurfaceSample> result = samples.samples();
  result.insert(result.end(), near_others.begin(), near_others.end());
  if (result.size() < task.num_samples) result.insert(result.end(), near_fixed.begin(), near_fixed.end());
  result.resize(task.num_samples);
  return result;
}

}  // namespace

std::vector<SurfaceSample> first_samples(const BaselineTask& task) {
  if (task.num_inner() == 0) return {task.fixed.begin(), task.fixed.end()};
  if (!task.fixed.empty()) return spread_samples(task);
  return random_samples(task.surface, task.sizing, task.num_inner(), task.seed);
}

}  // namespace fpo
