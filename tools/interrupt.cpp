#include "tools/interrupt.h"

#include <csignal>

#include "geom/check.h"

namespace tools {
namespace {

// A signal handler can reach nothing but a variable of static storage.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void note_signal(int signal) {
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

void stop_if_interrupted() {
  if (interrupt_flag()) throw geom::Interrupted();
}

}  // namespace tools
