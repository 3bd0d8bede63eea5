#pragma once
// A method that moves all samples a little, again and again: its iterations, as Algorithm 1 reports its own.

#include <functional>
#include <optional>
#include <span>

#include "fpo/baselines/baseline.h"
#include "fpo/stopwatch.h"

namespace fpo {

/// The parts of such a method.
struct IteratedMethod {
  /// One iteration: the number of samples that moved, with 0 the last one; none if nothing could be done, and
  /// it does not count.
  std::function<std::optional<std::size_t>(int iteration)> step;
  /// What would be the result now. Valid until the next step.
  std::function<std::span<const SurfaceSample>()> samples;
};

/// At most options.max_iterations steps, each announced as a move of all samples, with a report before the
/// first and after each. `watch`: since when the reports count their seconds.
OptimizeResult iterate(const BaselineTask& task, const OptimizeOptions& options, const IteratedMethod& method,
                       const Stopwatch& watch);

}  // namespace fpo
