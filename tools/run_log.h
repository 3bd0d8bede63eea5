#pragma once
// What a run of the optimization tells while it goes on: a progress line, and a table of its iterations.

#include <string>

#include "fpo/optimize.h"
#include "tools/progress.h"

namespace tools {

/// The table's head, and the line of an iteration.
inline constexpr const char* log_head = "iteration,moved,delta,mean_delta,seconds\n";
std::string log_line(const fpo::IterationReport& report);

class RunLog {
 public:
  explicit RunLog(bool quiet) : progress_("optimizing", quiet) {}
  /// Makes the run report here, and stop on a signal (interrupt.h). Keeps a reference to nothing but itself:
  /// it must outlive the run.
  void attach(fpo::OptimizeOptions& options, std::size_t num_samples);
  /// The head and a line for each iteration.
  const std::string& csv() const { return csv_; }

 private:
  Progress progress_;
  double delta_ = 0;
  std::string csv_ = log_head;
};

}  // namespace tools
