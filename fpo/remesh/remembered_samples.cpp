#include "fpo/remesh/remembered_samples.h"

#include "fpo/remesh/dual.h"

namespace fpo {

using geom::SiteId;

RememberedSamples::RememberedSamples(const SurfaceDomain& domain) : places_(samples_of(domain)) {
  for (std::size_t i = 0; i < places_.size(); ++i) weight_shares_.push_back(domain.weight_share(SiteId(i)));
}

void RememberedSamples::put_back(SurfaceDomain& domain) const {
  std::vector<SiteId> changed;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const SiteId x(i);
    const SurfaceSample& at = domain.sample(x);
    if (at.position == places_[i].position && at.facet == places_[i].facet &&
        domain.weight_share(x) == weight_shares_[i])
      continue;
    changed.push_back(x);
  }
  for (const SiteId x : changed) {
    domain.remove(x);
    domain.insert_at(x, places_[x.index()], weight_shares_[x.index()]);
  }
}

}  // namespace fpo
