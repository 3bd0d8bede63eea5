#pragma once
// A loop shared among threads.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace geom {

/// Calls body(first, last) for consecutive ranges of `grain` indices that together make [0, count), on up to
/// `threads` threads, the caller's among them. The ranges do not depend on the number of threads: if each
/// call writes only to places of its own range, neither does the result. An exception of the body ends the
/// loop early and is thrown again here (the first one caught, if several). Where the system
/// grants fewer threads, it makes do with them.
template <class Body>
void parallel_ranges(std::size_t count, std::size_t grain, int threads, const Body& body) {
  const std::size_t ranges = (count + grain - 1) / grain;
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_access;
  const auto work = [&] {
    try {
      for (std::size_t r; (r = next.fetch_add(1)) < ranges;)
        body(r * grain, std::min((r + 1) * grain, count));
    } catch (...) {
      const std::lock_guard lock(failure_access);
      if (!failure) failure = std::current_exception();
      next = ranges;
    }
  };
  {
    const std::size_t helpers = std::min(static_cast<std::size_t>(std::max(threads, 1)), ranges);
    std::vector<std::jthread> running;  // joined at the end of the block
    running.reserve(helpers);
    try {
      for (std::size_t i = 1; i < helpers; ++i) running.emplace_back(work);
    } catch (const std::system_error&) {  // no more to be had: then with fewer
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace geom
