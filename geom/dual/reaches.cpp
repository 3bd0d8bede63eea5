#include "geom/dual/reaches.h"

#include <algorithm>

namespace geom {

double Reaches::largest() {
  if (++asked_ > search_.size() / 2) {
    asked_ = 0;
    largest_ = of_nothing;
    for (const double bound : bounds_) largest_ = std::max(largest_, bound);
  }
  return largest_;
}

}  // namespace geom
