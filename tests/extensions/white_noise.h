#pragma once
// A method for table 1: independent random samples, as farthest point optimization begins with.

#include "fpo/baselines/baseline.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/scaling.h"

namespace fpo {

inline BaselineResult white_noise(const BaselineTask& task, const OptimizeOptions&) {
  BaselineResult result;
  result.samples.assign(task.fixed.begin(), task.fixed.end());
  if (task.num_inner() > 0)
    for (const SurfaceSample& x : random_samples(task.surface, task.sizing, task.num_inner(), task.seed))
      result.samples.push_back({geom::snapped(x.position), x.facet});
  result.run.last = measure(task, result.samples);
  return result;
}

}  // namespace fpo
