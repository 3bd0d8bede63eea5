#pragma once
// The samples on a surface and their weights.
//
// A sample where the sizing wants edges of length h has weight (c h)^2 (section 3.2 with k chosen so that the
// weight is a squared length), or 0 if the sizing is uniform (or on request): equal weights do nothing. The
// weight is that of the sample's own place: it changes as the sample moves.

#include <span>

#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_options.h"
#include "fpo/surface/surface_sample.h"
#include "geom/ids.h"
#include "geom/vec.h"

namespace fpo {

class WeightedSamples {
 public:
  /// Each with all of the weight that the sizing gives it. Of the options those of weights count.
  WeightedSamples(const Sizing& sizing, std::span<const SurfaceSample> samples,
                  const SurfaceOptions& options);
  WeightedSamples(WeightedSamples&&) = default;
  /// The same, with positions of their own.
  WeightedSamples copy() const { return *this; }
  /// From now on they are where these sites are, to whom a reference is kept: positions are not kept twice.
  void follow(const geom::Table<SiteId, geom::WeightedPoint3>& sites);

  std::size_t size() const { return facets_.size(); }
  SurfaceSample operator[](SiteId x) const {
    return {sites_ ? (*sites_)[x].position : positions_[x], facets_[x]};
  }
  /// Where they are.
  std::span<const geom::FacetId> facets() const { return facets_; }
  const Sizing& sizing() const { return sizing_; }

  /// x is at that place; if they follow sites, its site is there already and tells the position.
  void put(SiteId x, const SurfaceSample& place);
  /// The share of its full weight that x has, here and wherever it goes: not negative.
  void set_share(SiteId x, double share);
  double share(SiteId x) const { return shares_.empty() ? 1 : shares_[x]; }
  /// What the sizing gives x: (c h)^2, also if it is uniform.
  double full_weight(SiteId x) const { return full_weight_at((*this)[x]); }
  /// What a sample with all of its weight would have in the diagram there.
  double weight_at(const SurfaceSample& place) const;
  /// What x would have in the diagram there: its share of that, less what all have.
  double weight_at(const SurfaceSample& place, SiteId x) const;
  /// What x has in the diagram.
  double weight(SiteId x) const { return weight_at((*this)[x], x); }
  /// All weights are and have always been 0.
  bool have_no_weights() const { return unweighted_; }

 private:
  WeightedSamples(const WeightedSamples& other);
  double full_weight_at(const SurfaceSample& place) const;

  Sizing sizing_;
  double factor_;  ///< c
  bool equal_;     ///< full weights do not count
  bool unweighted_;
  geom::Table<SiteId, geom::FacetId> facets_;
  const geom::Table<SiteId, geom::WeightedPoint3>* sites_ = nullptr;
  geom::Table<SiteId, geom::Vec3> positions_;  ///< if they follow nobody
  geom::Table<SiteId, double> shares_;         ///< none as long as all are 1
};

}  // namespace fpo
