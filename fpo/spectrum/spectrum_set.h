#pragma once
// Samples made ready for differential_spectrum(): spacings, normals, periodic copies, the domain around them.

#include <span>

#include "fpo/spectrum/spectrum.h"
#include "fpo/spectrum/spectrum_surface.h"

namespace fpo {

/// Where the spacing r comes from. Always scaled so that the samples' hexagons, sqrt(3)/2 r^2 each, add up to
/// the area of the domain.
enum class SpacingRule {
  uniform,  ///< the same for all
  weights,  ///< r^2 proportional to the weight: w = (c h)^2, h the wanted edge length
  local     ///< r^2 proportional to the area of the disk with the 24 nearest samples; too large near a border
};

/// The rule that the weights suggest: weights if there are any (not all equal), else uniform.
template <class WeightedPoint>
SpacingRule rule_for(std::span<const WeightedPoint> samples) {
  for (const WeightedPoint& p : samples)
    if (p.weight != samples.front().weight) return SpacingRule::weights;
  return SpacingRule::uniform;
}

/// The rectangle [0, size.x] x [0, size.y], a torus or with a border.
struct PlaneRegion {
  geom::Vec2 size{1, 1};
  bool periodic = true;
};

/// `radius`: that of the spectrum, to know how far copies must reach. Throws geom::InputError if a sample
/// lies outside of a region that is not periodic, a weight that is needed is not positive, or copies would be
/// too many (few samples, great radius).
SpectrumSet plane_set(std::span<const geom::WeightedPoint2> samples, const PlaneRegion& region,
                      SpacingRule rule, double radius);

/// Samples should lie on the surface or near it. `detail`: how many times as many pieces a sample there are
/// as spectrum.h says; fewer are faster and blur what is expected at small frequencies. Throws
/// geom::InputError like plane_set().
SpectrumSet surface_set(std::span<const geom::WeightedPoint3> samples, const SpectrumSurface& surface,
                        SpacingRule rule, double detail = 1);

}  // namespace fpo
