#include "fpo/baselines/first_samples.h"

#include <algorithm>

#include "fpo/baselines/disks.h"
#include "fpo/surface/initial_samples.h"

namespace fpo {
namespace {

constexpr double room_of_fixed = 0.7;  // their cells reach half of h to both sides of a crease
constexpr std::size_t draws_per_sample = 3;

}  // namespace

std::vector<SurfaceSample> first_samples(const BaselineTask& task) {
  Disks samples(task.sizing, room_of_fixed);
  for (const SurfaceSample& x : task.fixed) samples.add(x);
  std::vector<SurfaceSample> result = samples.samples(), crowded;
  if (task.num_inner() == 0) return result;
  const std::size_t draws =
      task.fixed.empty()
          ? task.num_inner()
          : std::max(task.num_inner(), std::min(max_samples, draws_per_sample * task.num_inner()));
  for (const SurfaceSample& x : random_samples(task.surface, task.sizing, draws, task.seed))
    (samples.is_free(x.position) ? result : crowded).push_back(x);
  if (result.size() < task.num_samples) result.insert(result.end(), crowded.begin(), crowded.end());
  result.resize(task.num_samples);
  return result;
}

}  // namespace fpo
