#pragma once
// A sample as it was, to go back to.

#include "fpo/surface/surface_domain.h"

namespace fpo {

struct SampleState {
  SurfaceSample place;
  double weight_share;
};

inline SampleState state_of(const SurfaceDomain& domain, SiteId x) {
  return {domain.sample(x), domain.weight_share(x)};
}

/// A removal and an insertion if x is elsewhere or has another weight.
inline void put_back(SurfaceDomain& domain, SiteId x, const SampleState& was) {
  const SurfaceSample at = domain.sample(x);
  if (at.position == was.place.position && at.facet == was.place.facet &&
      domain.weight_share(x) == was.weight_share)
    return;
  domain.remove(x);
  domain.insert_at(x, was.place, was.weight_share);
}

}  // namespace fpo
