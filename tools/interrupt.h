#pragma once
// Ctrl-C that lets the move in hand finish. SIGTERM is the same.

#include <atomic>
#include <string>

namespace tools {

/// True once SIGINT or SIGTERM has arrived. The first call installs the handlers; a second signal ends the
/// program at once, and a signal that the program was started to ignore stays ignored.
const std::atomic<bool>& interrupt_flag();

/// Throws geom::Interrupted if one has.
void stop_if_interrupted();

/// While there is nothing to save, there is nothing to wait for either: from its making to end() or its own
/// end the first signal ends the program at once, with a line and the exit code of an interruption, whatever
/// it is at. One at a time; no output may be open.
class EndsAtOnce {
 public:
  /// Ends it if a signal has arrived before.
  explicit EndsAtOnce(const std::string& last_words);
  ~EndsAtOnce() { end(); }
  EndsAtOnce(const EndsAtOnce&) = delete;
  EndsAtOnce& operator=(const EndsAtOnce&) = delete;
  void end();
};

/// The last words before there is a result, and when all that was wanted is written.
std::string nothing_is_written(const std::string& program);
std::string all_is_written(const std::string& program);

inline constexpr const char* interrupt_help =
    "Ctrl-C (SIGINT, SIGTERM) ends the run with the result so far and exit code 130, a second one at once.";

}  // namespace tools
