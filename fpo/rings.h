#pragma once
// Samples and, ring by ring, those around them.

#include <algorithm>
#include <vector>

#include "geom/ids.h"

namespace fpo {

/// Appends those of `more` that are not there yet, in their order. O(there) each: for few.
template <class Sites>
void add_missing(std::vector<geom::SiteId>& samples, const Sites& more) {
  for (const geom::SiteId y : more)
    if (std::ranges::find(samples, y) == samples.end()) samples.push_back(y);
}

}  // namespace fpo
