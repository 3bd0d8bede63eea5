#include "fpo/baselines/iterations.h"

namespace fpo {

OptimizeResult iterate(const BaselineTask& task, const OptimizeOptions& options, const IteratedMethod& method,
                       const Stopwatch& watch) {
  OptimizeResult run;
  const auto report = [&](int iteration, std::size_t moved) {
    run.last = measure(task, method.samples());
    run.last.iteration = iteration;
    run.last.moved = moved;
    run.last.seconds = watch.seconds();
    run.moves += moved;
    if (options.on_iteration) options.on_iteration(run.last);
  };
  report(0, 0);
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    if (interrupted(options)) return run.reason = StopReason::interrupted, run;
    if (options.on_move) options.on_move(static_cast<std::size_t>(iteration - 1) * task.num_samples);
    const std::optional<std::size_t> moved = method.step(iteration);
    if (moved) report(iteration, *moved);
    if (moved.value_or(0) == 0) return run.reason = StopReason::nothing_moved, run;
  }
  return run;
}

}  // namespace fpo
