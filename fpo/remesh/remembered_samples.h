#pragma once
// Samples as they were, to go back to.

#include <vector>

#include "fpo/remesh/sample_state.h"

namespace fpo {

/// Places and weights of all samples of a domain.
class RememberedSamples {
 public:
  explicit RememberedSamples(const SurfaceDomain& domain);

  /// Puts those that are elsewhere, or have another weight, back: then the diagram is what it was, for it is
  /// a function of these. Of the same domain. O(1) expected for each of those.
  void put_back(SurfaceDomain& domain) const;

 private:
  std::vector<geom::Vec3> positions_;
  std::vector<geom::FacetId> facets_;
  std::vector<double> weight_shares_;  ///< or none, if all are 1
};

}  // namespace fpo
