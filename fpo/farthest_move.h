#pragma once
// A move that is no choice: for samples that must leave.

#include "fpo/domain.h"

namespace fpo {

/// Lines 5 to 7 of Algorithm 1 alone: x goes to the farthest point of all, also if its old place is farther.
/// False if there is no empty circle: then it is where it was.
inline bool move_to_farthest(Domain& domain, SiteId x) {
  domain.remove(x);
  const Circle c = domain.largest_empty(Scope::global);
  if (!c.id.valid()) return domain.put_back(x), false;
  domain.insert_at(x, c);
  return true;
}

}  // namespace fpo
