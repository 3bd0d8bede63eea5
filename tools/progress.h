#pragma once
// A progress line on a terminal.

#include <chrono>
#include <string>

namespace tools {

/// "optimizing  42%  delta 0.913  12 s to go", rewritten in place on stderr a few times a second and erased
/// at the end. Silent if stderr is no terminal or `quiet`.
class Progress {
 public:
  Progress(std::string label, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  bool is_visible() const { return visible_; }
  /// The share that is done, in [0, 1], and the delta reached. Cheap enough to be called before every move.
  void update(double done, double delta) {
    if (visible_) show(done, delta);
  }
  /// Removes the line, so that other text can be printed.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;
  void show(double done, double delta);

  std::string label_;
  bool visible_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// The line's text: "optimizing  42%  delta 0.913  12 s to go" after `seconds` of work.
std::string progress_text(const std::string& label, double done, double delta, double seconds);

}  // namespace tools
