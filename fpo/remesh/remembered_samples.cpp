#include "fpo/remesh/remembered_samples.h"

namespace fpo {

using geom::SiteId;

RememberedSamples::RememberedSamples(const SurfaceDomain& domain) {
  const std::size_t count = domain.num_samples();
  positions_.reserve(count);
  facets_.reserve(count);
  bool are_full = true;
  for (std::size_t i = 0; i < count; ++i) {
    const SurfaceSample& x = domain.sample(SiteId(i));
    positions_.push_back(x.position);
    facets_.push_back(x.facet);
    are_full &= domain.weight_share(SiteId(i)) == 1;
  }
  if (are_full) return;
  for (std::size_t i = 0; i < count; ++i) weight_shares_.push_back(domain.weight_share(SiteId(i)));
}

void RememberedSamples::put_back(SurfaceDomain& domain) const {
  for (std::size_t i = 0; i < positions_.size(); ++i)
    fpo::put_back(domain, SiteId(i),
                  {{positions_[i], facets_[i]}, weight_shares_.empty() ? 1 : weight_shares_[i]});
}

}  // namespace fpo
