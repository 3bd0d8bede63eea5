#include "tools/interrupt.h"

#include <unistd.h>

#include <array>
#include <csignal>

#include "geom/check.h"
#include "tools/cli.h"

namespace tools {
namespace {

// A signal handler can reach nothing but a variable of static storage.
std::atomic<bool> interrupted = false;
std::atomic<bool> at_once = false;
std::array<char, 200> last_words;
static_assert(std::atomic<bool>::is_always_lock_free);

/// Only what a signal handler may do. Where it is written to may be closed or full: it ends even so.
[[noreturn]] void end_here() {
  std::size_t length = 0;
  while (length < last_words.size() && last_words[length] != 0) ++length;
  if (::write(STDERR_FILENO, last_words.data(), length) < 0) ::_exit(exit_interrupted);
  ::_exit(exit_interrupted);
}

extern "C" void note_signal(int signal) {
  if (at_once) end_here();
  if (!interrupted.exchange(true)) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

bool install(int signal) {
  if (std::signal(signal, note_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  return true;
}

}  // namespace

const std::atomic<bool>& interrupt_flag() {
  static const bool installed = install(SIGINT) && install(SIGTERM);
  static_cast<void>(installed);
  return interrupted;
}

EndsAtOnce::EndsAtOnce(const std::string& last) {
  last_words.fill(0);
  last.copy(last_words.data(), last_words.size() - 1);
  at_once = true;
  if (interrupt_flag()) end_here();
}

void EndsAtOnce::end() { at_once = false; }

std::string nothing_is_written(const std::string& program) {
  return program + ": " + geom::Interrupted().what() + ": nothing is written\n";
}

std::string all_is_written(const std::string& program) {
  return program + ": interrupted when all was written, before it was measured\n";
}

void stop_if_interrupted() {
  if (interrupt_flag()) throw geom::Interrupted();
}

}  // namespace tools
