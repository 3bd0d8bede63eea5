#include "tools/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "tools/worded.h"

namespace tools {
namespace {

/// "12 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds) {
  const long s = std::lround(std::min(seconds, 1e8));
  if (s < 60) return worded("%ld s", s);
  if (s < 3600) return worded("%ld min %02ld s", s / 60, s % 60);
  return worded("%ld h %02ld min", s / 3600, s / 60 % 60);
}

}  // namespace

std::string progress_text(const std::string& label, double done, double delta, double seconds) {
  done = std::clamp(done, 0.0, 1.0);
  std::string text = label + worded("  %3d%%  delta %.3f", static_cast<int>(100 * done), delta);
  if (done > 0 && seconds > 0) text += "  " + duration_text(seconds / done * (1 - done)) + " to go";
  return text;
}

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), visible_(!quiet && isatty(STDERR_FILENO)) {}

Progress::~Progress() { erase(); }

void Progress::erase() {
  if (std::exchange(drawn_, false)) std::fputs("\r\033[K", stderr);
}

void Progress::show(double done, double delta) {
  const Clock::time_point now = Clock::now();
  if (drawn_ && now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r%s\033[K", progress_text(label_, done, delta, seconds).c_str());
}

}  // namespace tools
