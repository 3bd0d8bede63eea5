#include "fpo/surface/weighted_samples.h"

#include "geom/check.h"
#include "geom/mesh/scaling.h"

namespace fpo {
namespace {

constexpr double weight_unit = geom::coordinate_unit * geom::coordinate_unit;

}  // namespace

WeightedSamples::WeightedSamples(const Sizing& sizing, std::span<const SurfaceSample> samples,
                                 const SurfaceOptions& options)
    : sizing_(sizing),
      factor_(options.weight_factor),
      equal_(sizing.is_uniform() || !options.weighted),
      unweighted_(equal_) {
  geom::require(!samples.empty(), "there must be at least one sample");
  facets_.reserve(samples.size());
  positions_.reserve(samples.size());
  for (const SurfaceSample& sample : samples) {
    facets_.push_back(sample.facet);
    positions_.push_back(sample.position);
  }
}

WeightedSamples::WeightedSamples(const WeightedSamples& other)
    : sizing_(other.sizing_),
      factor_(other.factor_),
      equal_(other.equal_),
      unweighted_(other.unweighted_),
      facets_(other.facets_),
      shares_(other.shares_) {
  positions_.reserve(size());
  for (SiteId x(0); x.index() < size(); x = SiteId(x.value + 1)) positions_.push_back(other[x].position);
}

void WeightedSamples::follow(const geom::Table<SiteId, geom::WeightedPoint3>& sites) {
  sites_ = &sites;
  positions_ = {};
}

void WeightedSamples::put(SiteId x, const SurfaceSample& place) {
  facets_[x] = place.facet;
  if (!sites_) positions_[x] = place.position;
}

void WeightedSamples::set_share(SiteId x, double share) {
  geom::ensure(share >= 0, "the share of a weight must not be negative");
  if (share == 1 && shares_.empty()) return;
  if (shares_.empty()) shares_.assign(size(), 1);
  shares_[x] = share;
  unweighted_ &= share == 1;
}

double WeightedSamples::full_weight_at(const SurfaceSample& place) const {
  const double radius = factor_ * sizing_.at(place);
  return radius * radius;
}

double WeightedSamples::weight_at(const SurfaceSample& place) const {
  const double radius = factor_ * sizing_.at(place);
  return equal_ ? 0 : geom::snapped(radius * radius, weight_unit);
}

/// Equal weights are 0, whatever they are. A smaller one is negative then.
double WeightedSamples::weight_at(const SurfaceSample& place, SiteId x) const {
  if (equal_ && share(x) == 1) return 0;
  return geom::snapped((share(x) - (equal_ ? 1 : 0)) * full_weight_at(place), weight_unit);
}

}  // namespace fpo
