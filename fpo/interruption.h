#pragma once
// Who works long looks between two steps whether somebody wants the end.

#include <atomic>

namespace fpo {

/// Whether there is a flag, and it is set. Any thread may set it, a signal handler too.
inline bool interrupted(const std::atomic<bool>* flag) {
  return flag && flag->load(std::memory_order_relaxed);
}

}  // namespace fpo
