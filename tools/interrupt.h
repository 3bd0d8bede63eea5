#pragma once
// Ctrl-C that lets the move in hand finish.

#include <atomic>

namespace tools {

/// True once SIGINT or SIGTERM has arrived. The first call installs the handlers; a second signal ends the
/// program at once, and a signal that the program was started to ignore stays ignored.
const std::atomic<bool>& interrupt_flag();

}  // namespace tools
