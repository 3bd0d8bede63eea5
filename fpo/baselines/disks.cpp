#include "fpo/baselines/disks.h"

#include <algorithm>
#include <cmath>

#include "fpo/stopwatch.h"
#include "fpo/surface/initial_samples.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"

namespace fpo {

SiteId Disks::add(const SurfaceSample& x) {
  const SiteId id(samples_.size());
  samples_.push_back(x);
  tree_.insert(id, point(x));
  return id;
}

geom::WeightedPoint3 Disks::point(const SurfaceSample& x) const {
  const double radius = radius_factor_ * sizing_.at(x);
  return {x.position, geom::snapped(radius * radius, geom::coordinate_unit * geom::coordinate_unit)};
}

namespace {

std::size_t difference(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

}  // namespace

BaselineResult search_radius(const BaselineTask& task, const OptimizeOptions& options,
                             const DiskSampling& sample) {
  const Stopwatch watch;
  const std::size_t tolerance = task.num_samples / 1000;
  BaselineResult best;
  const bool given = task.radius_factor > 0;
  double c = given ? task.radius_factor : usual_radius_factor;
  for (int attempt = 1;; ++attempt) {
    if (options.on_move) options.on_move(static_cast<std::size_t>(attempt - 1) * task.num_samples);
    std::vector<SurfaceSample> samples = sample(c);
    const bool stopped = interrupted(options);
    if (stopped && attempt == 1) throw geom::Interrupted();
    const std::size_t number = samples.size();
    if (attempt == 1 || (!stopped && difference(number, task.num_samples) <
                                         difference(best.samples.size(), task.num_samples))) {
      best.samples = std::move(samples);
      best.radius_factor = c;
      best.run.last = measure(task, best.samples);
    }
    best.run.last.iteration = attempt;
    best.run.last.moved = number;
    best.run.last.seconds = watch.seconds();
    if (options.on_iteration) options.on_iteration(best.run.last);
    best.run.moves += number;
    if (stopped) return best.run.reason = StopReason::interrupted, best;
    if (given || difference(number, task.num_samples) <= tolerance)
      return best.run.reason = StopReason::target_reached, best;
    if (attempt >= options.max_iterations) return best.run.reason = StopReason::iteration_cap, best;
    const double inner = static_cast<double>(std::max<std::size_t>(number - task.fixed.size(), 1));
    c *= std::sqrt(inner / static_cast<double>(std::max<std::size_t>(task.num_inner(), 1)));
  }
}

std::vector<SurfaceSample> random_pool(const BaselineTask& task, std::size_t per_sample) {
  if (task.num_inner() == 0) return {};
  const std::size_t size = std::max(task.num_samples, std::min(max_samples, per_sample * task.num_samples));
  return random_samples(task.surface, task.sizing, size, task.seed);
}

}  // namespace fpo
