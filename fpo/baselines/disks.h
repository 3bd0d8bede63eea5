#pragma once
// Poisson disks: samples with a radius each, no one in the disk of an earlier one. Shared by maximal and by
// constrained Poisson-disk sampling.
//
// The disk of a sample where the sizing wants edges of length h has radius c h, in space. In power (paper,
// equation 1) with weights (c h)^2 a location is outside all disks iff its power to the nearest sample is
// positive, so one search for the nearest sample tells.

#include <functional>

#include "fpo/baselines/baseline.h"
#include "geom/sites/site_tree.h"

namespace fpo {

/// A set of disks that grows.
class Disks {
 public:
  /// Keeps a reference. `radius_factor` is c.
  Disks(const Sizing& sizing, double radius_factor) : sizing_(sizing), radius_factor_(radius_factor) {}

  /// Whether the location is in no disk. O(log n) expected.
  bool is_free(const geom::Vec3& x) const {
    return samples_.empty() || tree_.nearest(x, SiteId()).radius2 > 0;
  }
  /// Puts a disk at x whether that is free or not; its id is the number of those before. O(log n) expected.
  SiteId add(const SurfaceSample& x);
  /// The disk as a weighted point.
  geom::WeightedPoint3 point(const SurfaceSample& x) const;

  const std::vector<SurfaceSample>& samples() const { return samples_; }
  const geom::SiteTree& tree() const { return tree_; }

 private:
  const Sizing& sizing_;
  double radius_factor_;
  std::vector<SurfaceSample> samples_;
  geom::SiteTree tree_;
};

/// A method that has a radius where others have a number of samples: the samples for c, those that are fixed
/// first.
using DiskSampling = std::function<std::vector<SurfaceSample>(double radius_factor)>;

/// How large c is if n disks are packed as densely as random ones come to be: they cover .547 of the plane if
/// their radii are halved.
inline constexpr double usual_radius_factor = 0.777;

/// Searches the c for which about the wanted number of samples comes out: tries c sqrt(number / wanted) next,
/// as the number goes with c^-2, until at most one sample in a thousand is missing or too much, or
/// options.max_iterations radii have been tried. The result is that with the nearest number (of equal ones
/// the first). The number scatters from radius to radius as it does from seed to seed, so the search ends
/// near the number, seldom on it. If interrupted, the try in hand does not count; throws geom::Interrupted if
/// it is the first.
BaselineResult search_radius(const BaselineTask& task, const OptimizeOptions& options,
                             const DiskSampling& sample);

/// Random samples to choose from, so many for each wanted; none if all are fixed.
std::vector<SurfaceSample> random_pool(const BaselineTask& task, std::size_t per_sample);

}  // namespace fpo
