#include "fpo/baselines/cps.h"

#include <algorithm>

#include "fpo/baselines/disks.h"
#include "fpo/surface/initial_samples.h"

namespace fpo {
namespace {

constexpr std::size_t pool_per_sample = 15;  // with it the quality is that of the tables (10: less, 20: more)

}  // namespace

// The pool is in random order: to pick a random one of those left is to take the next that is left, and a
// sample is left as long as it is in no disk.
BaselineResult constrained_poisson_disks(const BaselineTask& task, const OptimizeOptions& options) {
  const std::vector<SurfaceSample> pool = random_pool(task, pool_per_sample);
  return search_radius(task, options, [&](double radius_factor) {
    Disks disks(task.sizing, radius_factor);
    for (const SurfaceSample& x : task.fixed) disks.add(x);
    for (const SurfaceSample& x : pool) {
      if (disks.is_free(x.position)) disks.add(x);
      if (interrupted(options)) break;
    }
    return disks.samples();
  });
}

}  // namespace fpo
