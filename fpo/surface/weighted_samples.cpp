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
      unweighted_(equal_),
      places_(samples.begin(), samples.end()) {
  geom::require(!samples.empty(), "there must be at least one sample");
}

void WeightedSamples::set_share(SiteId x, double share) {
  geom::ensure(share >= 0, "the share of a weight must not be negative");
  if (share == 1 && shares_.empty()) return;
  if (shares_.empty()) shares_.assign(places_.size(), 1);
  shares_[x] = share;
  unweighted_ &= share == 1;
}

double WeightedSamples::full_weight(SiteId x) const {
  const double radius = factor_ * sizing_.at(places_[x]);
  return radius * radius;
}

double WeightedSamples::weight_at(const SurfaceSample& place) const {
  const double radius = factor_ * sizing_.at(place);
  return equal_ ? 0 : geom::snapped(radius * radius, weight_unit);
}

/// Equal weights are 0, whatever they are. A smaller one is negative then.
double WeightedSamples::weight(SiteId x) const {
  if (equal_ && share(x) == 1) return 0;
  return geom::snapped((share(x) - (equal_ ? 1 : 0)) * full_weight(x), weight_unit);
}

}  // namespace fpo
