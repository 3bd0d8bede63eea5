#pragma once
// Delta debugging (Zeller, Hildebrandt: Simplifying and isolating failure-inducing input, 2002).

#include <algorithm>
#include <vector>

namespace endurance {

/// A subsequence that still fails and from which no single element can be left out without its passing.
/// `fails(items)` must hold. Cost: O(n log n) to O(n^2) calls, of which at most `most_calls` are made: the
/// best so far is returned then.
template <class T, class Fails>
std::vector<T> minimised(std::vector<T> items, const Fails& fails, std::size_t most_calls) {
  std::size_t calls = 0;
  const auto without = [&](std::size_t first, std::size_t last) {
    std::vector<T> rest(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first));
    rest.insert(rest.end(), items.begin() + static_cast<std::ptrdiff_t>(last), items.end());
    return rest;
  };
  for (std::size_t chunk = std::max<std::size_t>(1, items.size() / 2); calls < most_calls;) {
    bool smaller = false;
    // From the end: what came last can be left out most often.
    for (std::size_t last = items.size(); last > 0 && calls < most_calls;) {
      const std::size_t first = last > chunk ? last - chunk : 0;
      std::vector<T> rest = without(first, last);
      ++calls;
      if (fails(rest)) {
        items = std::move(rest);
        smaller = true;
      }
      last = first;
    }
    if (chunk == 1 && !smaller) break;
    if (!smaller || chunk > items.size()) chunk = std::max<std::size_t>(1, chunk / 2);
  }
  return items;
}

}  // namespace endurance
