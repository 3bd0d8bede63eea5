#pragma once
// What one update of a regular triangulation did.

#include <span>
#include <vector>

#include "geom/ids.h"

namespace geom {

/// Valid until the next update.
struct RegularChange {
  std::span<const SimplexId> destroyed;
  std::span<const SimplexId> created;
  std::span<const SiteId> hidden;   ///< sites that lost their last simplex (the inserted one included)
  std::span<const SiteId> exposed;  ///< sites that were hidden and are vertices since
};

/// The same while it is being found out.
struct ChangeLists {
  std::vector<SimplexId> destroyed, created;
  std::vector<SiteId> hidden, exposed;

  void clear() {
    destroyed.clear();
    created.clear();
    hidden.clear();
    exposed.clear();
  }
  RegularChange view() const { return {destroyed, created, hidden, exposed}; }
};

}  // namespace geom
