#include "tools/run_log.h"

#include <algorithm>

#include "tools/interrupt.h"
#include "tools/worded.h"

namespace tools {

std::string log_line(const fpo::IterationReport& r) {
  return worded("%d,%zu,%.6f,%.6f,%.6f\n", r.iteration, r.moved, r.delta, r.mean_delta, r.seconds);
}

void RunLog::attach(fpo::OptimizeOptions& options, std::size_t num_samples) {
  const double moves = std::max(1.0, static_cast<double>(num_samples) * options.max_iterations);
  options.interrupted = &interrupt_flag();
  options.on_move = [this, moves](std::size_t move) {
    progress_.update(static_cast<double>(move) / moves, delta_);
  };
  options.on_iteration = [this](const fpo::IterationReport& r) {
    delta_ = r.delta;
    csv_ += log_line(r);
  };
}

}  // namespace tools
