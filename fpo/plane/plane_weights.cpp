#include "fpo/plane/plane_weights.h"

#include <cmath>

#include "geom/check.h"

namespace fpo {

double PlaneWeights::edge_length(SiteId x, double weight) const {
  return is_uniform() ? scale_ : std::sqrt(weight / share(x)) / factor_;
}

double PlaneWeights::full_weight(const geom::Vec2& place) const {
  if (is_uniform()) return 0;
  const double radius = factor_ * edge_length(place);
  return radius * radius;
}

void PlaneWeights::set_share(SiteId x, double share, std::size_t num_samples) {
  geom::ensure(share > 0 && share <= 1, "the share of a weight must be in (0, 1]");
  if (shares_.empty() && share < 1) shares_.assign(num_samples, 1.0);
  if (!shares_.empty()) shares_[x] = share;
}

}  // namespace fpo
