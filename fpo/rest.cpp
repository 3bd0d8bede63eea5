#include "fpo/rest.h"

#include <algorithm>
#include <iterator>

namespace fpo {

std::vector<SiteId> restless(Domain& domain, std::span<const SiteId> samples, double rest_spacing) {
  std::vector<SiteId> result;
  if (rest_spacing == no_rest) {
    result.assign(samples.begin(), samples.end());
    return result;
  }
  geom::Table<SiteId, char> wakes(domain.num_samples(), false);
  std::vector<SiteId> neighbours;
  for (const SiteId x : samples) {
    if (domain.normalized_spacing(x) >= rest_spacing) continue;
    wakes[x] = true;
    domain.neighbours(x, neighbours);
    for (const SiteId y : neighbours) wakes[y] = true;
  }
  std::ranges::copy_if(samples, std::back_inserter(result), [&](SiteId x) { return wakes[x] != 0; });
  return result;
}

}  // namespace fpo
