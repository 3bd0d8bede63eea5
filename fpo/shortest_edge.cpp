#include "fpo/shortest_edge.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "fpo/interruption.h"
#include "geom/indexed_heap.h"

namespace fpo {

namespace {

// A sample whose farthest point has this many of its old neighbours around it did not leave its hole. The
// paper stops at the first sample that stays; in real numbers it still creeps towards the center of its hole,
// and early on a sample may stay by chance while shorter edges elsewhere are yet to go.
constexpr std::size_t home_neighbours = 3;
constexpr int patience = 128;

std::size_t num_common(const std::vector<SiteId>& a, const std::vector<SiteId>& b) {
  return static_cast<std::size_t>(std::count_if(
      a.begin(), a.end(), [&](SiteId x) { return std::find(b.begin(), b.end(), x) != b.end(); }));
}

}  // namespace

ShortestEdgeResult remove_shortest_edges(Domain& domain, const ShortestEdgeOptions& options) {
  // The heap's largest entry is the sample of least spacing.
  geom::IndexedHeap<SiteId, std::less<SiteId>> samples;
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    if (!domain.is_fixed(SiteId(i))) samples.push(SiteId(i), -domain.normalized_spacing(SiteId(i)));

  std::vector<SiteId> before, after;
  const auto refresh = [&](SiteId y) {
    if (!domain.is_fixed(y)) samples.update(y, -domain.normalized_spacing(y));
  };
  ShortestEdgeResult result;
  int stayed = 0;  // moves in a row
  const std::size_t most = options.max_moves_per_sample * domain.num_samples();
  while (result.moves < most && !samples.empty()) {
    if (interrupted(options.interrupted)) break;
    if (options.on_move) options.on_move(result.moves);
    const SiteId x = samples.top().slot;
    domain.neighbours(x, before);
    ++result.moves;
    if (!domain.move(x, Scope::global)) {
      result.converged = true;
      break;
    }
    domain.neighbours(x, after);
    for (const SiteId y : before) refresh(y);
    for (const SiteId y : after) refresh(y);
    refresh(x);
    stayed = num_common(before, after) >= home_neighbours ? stayed + 1 : 0;
    if (stayed == patience) {
      result.converged = true;
      break;
    }
  }
  return result;
}

}  // namespace fpo
