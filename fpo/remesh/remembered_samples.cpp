#include "fpo/remesh/remembered_samples.h"

namespace fpo {

using geom::SiteId;

RememberedSamples::RememberedSamples(const SurfaceDomain& domain) {
  states_.reserve(domain.num_samples());
  for (std::size_t i = 0; i < domain.num_samples(); ++i) states_.push_back(state_of(domain, SiteId(i)));
}

void RememberedSamples::put_back(SurfaceDomain& domain) const {
  for (std::size_t i = 0; i < states_.size(); ++i) fpo::put_back(domain, SiteId(i), states_[i]);
}

}  // namespace fpo
