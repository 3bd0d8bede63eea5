#pragma once
// Ctrl-C that lets the move in hand finish. SIGTERM is the same.

#include <atomic>

namespace tools {

/// True once SIGINT or SIGTERM has arrived. The first call installs the handlers; a second signal ends the
/// program at once, and a signal that the program was started to ignore stays ignored.
const std::atomic<bool>& interrupt_flag();

/// Throws geom::Interrupted if one has.
void stop_if_interrupted();

inline constexpr const char* interrupt_help =
    "Ctrl-C (SIGINT, SIGTERM) ends the run with the result so far and exit code 130, a second one at once.";

}  // namespace tools
