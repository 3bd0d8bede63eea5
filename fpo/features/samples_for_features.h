#pragma once
// How many samples keep all features, told before anything is sampled.
//
// An edge between neighbours a, b on a curve is one of the remesh if the ball about the place m of the curve
// that is as far from both holds no other sample (proven_edges.h). Its radius is half the edge; edges on
// curves are at most 1.25 wanted lengths h (feature_samples.h). Who could be in it:
//
// 1. Samples that are not on features. Optimization keeps them .9 wanted lengths from all others, hence from
//    a and b; a sample at distance d from both is in the ball only if 2 d^2 < L^2, L being the edge, and
//    2 (.9)^2 > (1.25)^2. This alone is measured and not proven: where lengths differ some come as near as
//    .7, and balls are emptied by weights (emptied_balls.h); what came of it is proven_feature_edges.
// 2. Samples of another curve, or of another part of the same, at a clearance w (curve_clearance.h): none is
//    if 1.25 h <= 2 w, that is h <= 1.6 w. Either lengths are so small everywhere, or they are lowered across
//    a strip between curves to 1.5 w (curve_spacing.h), where n suffices for that. What that takes is bounded
//    from above: beside a part of a curve of length l it is, with density 2 / (sqrt(3) h^2), the strip's half
//    with h = 1.5 w, and on the other side the integral over h = 1.5 w + g d, g being the gradation, up to
//    h = s: (1 / 1.5 w - 1 / s) / g. The others may become longer by 1.35, which leaves 1 - 1 / 1.35^2 of n.
//    Elsewhere h is then up to 1.35 s.
// 3. Samples of a curve that meets the first one at a corner with an angle a. With a edges of length e on
//    either, equally far from the corner, spheres about it have both on them, so a ball between two spheres
//    holds none. They are off by as much as numbers of edges are rounded, 1.5 e / k an edge for k edges. At
//    the j-th one that is j 1.5 e / k, and curves are so far apart that up to 2 (1 + j)^2 (1 - cos a) e does
//    no harm; half of that is left where curves bend (clearance says where they bend more). That is so for
//    all j if k >= .375 / (1 - cos a). Below 60 degrees at least two edges are needed, three with small
//    angles at both ends, so that first samples are on one sphere at all; between 60 and 90 lengths of
//    1.25 cos a, or .63, for edges of .63 to 1.25.
//
// All of that holds if curves have as many edges as they call for. On bodies of bars, whose samples are
// nearly all on curves, that and what is between (inner_share.h), with lengths up to 1.35, may be more than
// n, though n is what the area calls for: so many samples are asked for that they suffice.
//
// No curve collapses (feature_choice.h) if the spacing is at most twice its length, but for ends of strips;
// none is given up if features need no more than half of the samples; a quarter is asked for, so that faces
// have some, too. All conditions become weaker with n.

#include <cstddef>
#include <span>

#include "fpo/features/features.h"
#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_sample.h"

namespace fpo {

/// What calls for the samples.
enum class FeatureNeed { number, short_curves, close_curves, small_angles };

struct FeatureBound {
  std::size_t samples = 0;  ///< 0: no number that is worth being told; no features, too
  FeatureNeed need = FeatureNeed::number;
};

struct FeatureBoundTask {
  const geom::TriMesh& mesh;
  const Features& features;  ///< with all corners, none collapsed
  std::span<const SurfaceSample> fixed;
  Sizing sizing;  ///< that of n samples; that of others is proportional
  std::size_t n = 0;
  bool yielding = false;  ///< features may take a share of the samples only
  double gradation = 0;   ///< beside narrow places; 0: lengths are not lowered there
};

/// The number of samples from which on all curves are kept and the ball of each of their edges is empty of
/// other samples of the features. Not more than
/// some 1e8. It does not depend on n if the sizing is uniform. O(places of curve_clearances and, where most
/// samples are on curves, of InnerShare).
FeatureBound samples_for_features(const FeatureBoundTask& task);

}  // namespace fpo
