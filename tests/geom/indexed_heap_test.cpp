#include "geom/indexed_heap.h"

#include <map>

#include "doctest.h"
#include "geom/ids.h"
#include "geom/rng.h"

using geom::CircleId;

namespace {

struct SmallerIdFirst {
  bool operator()(CircleId a, CircleId b) const { return a < b; }
};
using Heap = geom::IndexedHeap<CircleId, SmallerIdFirst>;

/// The top by linear scan.
CircleId top_of(const std::map<CircleId, double>& content) {
  CircleId best;
  for (const auto& [slot, key] : content)
    if (!best.valid() || key > content.at(best)) best = slot;  // ascending ids: the first of equals stays
  return best;
}

}  // namespace

TEST_CASE("indexed heap: the top is that of a linear scan after every operation, with many equal keys") {
  geom::Rng rng(3);
  for (const std::uint64_t distinct_keys : {3u, 1000u}) {
    Heap heap;
    std::map<CircleId, double> content;
    for (int step = 0; step < 20000; ++step) {
      const CircleId slot(static_cast<std::size_t>(rng.below(200)));
      const double key = static_cast<double>(rng.below(distinct_keys));
      REQUIRE(heap.contains(slot) == content.contains(slot));
      if (!content.contains(slot)) {
        heap.push(slot, key);
        content[slot] = key;
      } else if (rng.below(2) == 0) {
        heap.erase(slot);
        content.erase(slot);
      } else {
        heap.update(slot, key);
        content[slot] = key;
      }
      REQUIRE(heap.size() == content.size());
      if (!content.empty()) {
        REQUIRE(heap.top().slot == top_of(content));
        REQUIRE(heap.top().key == content[heap.top().slot]);
      }
      if (step % 50 == 0) heap.check();
    }
  }
}

TEST_CASE("indexed heap: drained, it sorts") {
  geom::Rng rng(9);
  Heap heap;
  for (std::size_t i = 0; i < 1000; ++i) heap.push(CircleId(i), static_cast<double>(rng.below(300)));
  double last = 1e9;
  CircleId previous;
  while (!heap.empty()) {
    const auto [key, slot] = heap.top();
    CHECK((key < last || (key == last && previous < slot)));
    last = key, previous = slot;
    heap.erase(slot);
  }
}
