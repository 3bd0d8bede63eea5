#include "tools/run_log.h"

#include <algorithm>
#include <cstdio>

#include "tools/interrupt.h"

namespace tools {

void RunLog::attach(fpo::OptimizeOptions& options, std::size_t num_samples) {
  const double moves = std::max(1.0, static_cast<double>(num_samples) * options.max_iterations);
  options.interrupted = &interrupt_flag();
  options.on_move = [this, moves](std::size_t move) {
    progress_.update(static_cast<double>(move) / moves, delta_);
  };
  options.on_iteration = [this](const fpo::IterationReport& r) {
    delta_ = r.delta;
    char line[160];
    std::snprintf(line, sizeof line, "%d,%zu,%.6f,%.6f,%.6f\n", r.iteration, r.moved, r.delta, r.mean_delta,
                  r.seconds);
    csv_ += line;
  };
}

}  // namespace tools
