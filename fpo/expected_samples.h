#pragma once
// Who will be moved soon (Domain::expect): so that memory is loaded in several steps, a move apart, of which
// each needs what the one before has loaded.

#include <array>

#include "geom/ids.h"

namespace fpo {

/// The samples that were announced last.
class ExpectedSamples {
 public:
  /// x will be moved four calls later. Calls load(sample, calls) for x, with 4, and for those announced
  /// before it that are still to come, with 3, 2 and 1.
  template <class Load>
  void announce(geom::SiteId x, Load&& load) {
    load(x, 4);
    for (int i = 0; i < 3; ++i)
      if (const geom::SiteId y = before_[static_cast<std::size_t>(i)]; y.valid()) load(y, 3 - i);
    before_ = {x, before_[0], before_[1]};
  }

 private:
  std::array<geom::SiteId, 3> before_;  ///< the latest first
};

}  // namespace fpo
