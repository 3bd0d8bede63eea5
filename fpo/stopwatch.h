#pragma once
// Seconds of the clock on the wall.

#include <chrono>

namespace fpo {

/// Runs from the start of its life.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace fpo
