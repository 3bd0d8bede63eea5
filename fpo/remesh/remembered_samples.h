#pragma once
// Samples as they were, to go back to.

#include <vector>

#include "fpo/remesh/sample_state.h"

namespace fpo {

/// Places and weights of all samples of a domain.
class RememberedSamples {
 public:
  /// `older`: if given, samples of the same domain before; those that are as they were are not kept twice,
  /// unless these lean on older ones themselves. Keeps a reference to it.
  explicit RememberedSamples(const SurfaceDomain& domain, const RememberedSamples* older = nullptr);

  /// Puts those that are elsewhere, or have another weight, back: then the diagram is what it was, for it is
  /// a function of these. Of the same domain. O(1) expected for each of those.
  void put_back(SurfaceDomain& domain) const;

  struct Changed {
    SiteId sample;
    SampleState was;
  };
  /// Those that it would put back, ascending, as they were. O(n).
  std::vector<Changed> changed_in(const SurfaceDomain& domain) const;

 private:
  SampleState kept(std::size_t i) const;  ///< without `older`

  const RememberedSamples* older_;
  std::vector<Changed> changed_;  ///< since then, ascending
  std::vector<geom::Vec3> positions_;
  std::vector<geom::FacetId> facets_;
  std::vector<double> weight_shares_;  ///< or none, if all are 1
};

}  // namespace fpo
