#pragma once
// Samples of curves that face each other. The ball about the place of a curve that is as far from one of
// two neighbours on it as from the other must hold no other sample: then their cells meet there, and the
// edge between them is one of the restricted Delaunay triangulation (cf. the protecting balls of Cheng,
// Dey, Levine 2007). Even spacing alone (paper, section 5) does not see to that where curves are closer
// to each other than half an edge.

#include <span>
#include <vector>

#include "fpo/features/curve_domain.h"
#include "fpo/features/feature_samples.h"

namespace fpo {

/// An edge of a chain, and the sample of the features that is deepest in the ball about it.
struct CrowdedEdge {
  std::size_t curve = 0;
  std::size_t edge = 0;  ///< from this sample of the chain to the next
  SiteId intruder;
};

/// Is x at most as far from c as a is? Exact in the stored doubles.
bool is_as_near(const geom::Vec3& c, const geom::Vec3& a, const geom::Vec3& x);

/// Where the samples of each chain are in the metric of its curve, ascending; the last of a loop is the first
/// one and the length of the curve.
using ChainPlaces = std::vector<std::vector<double>>;

/// Those whose ball holds another sample of the features, ascending. The middle of an edge of the chain is
/// found by bisection and rounded; what is in the ball about it is decided exactly. O(edges * samples in a
/// slab that is twice as wide as the edge).
std::vector<CrowdedEdge> crowded_edges(std::span<const CurveMetric> metrics, const ChainPlaces& places,
                                       const FeatureSamples& samples);

struct FacingLimits {
  std::size_t most;        ///< samples
  std::size_t wanted = 0;  ///< on curves, for there is no room for them elsewhere
};

/// Makes the ball of each chain edge empty of other samples of the features, as long as there are no more
/// than `most` of these. The neighbour that is nearest to the intruder's foot on the curve goes there; if
/// none is near a sample is added there, or in the middle where there is one already, on arcs. Edges that
/// are left longer than 1.25 are divided. A sample above its foot is in the ball of neither edge that
/// begins there, so one sample a sample is enough for straight curves side by side, whatever their
/// distance. Corners and points of the user stay. An edge whose intruder is nearer than .02 of it to the
/// curve is left as it is. If all balls are empty, and fewer than `wanted` are there, the longest edges, 200
/// at most, are divided where those that face the new ones keep that so. Changes nothing if no edge is
/// crowded at first. How many are in the end. Deterministic. At most twenty rounds of the cost of
/// crowded_edges(), and as many as edges that are divided for `wanted`.
std::size_t face_each_other(const Features& features, std::span<const CurveMetric> metrics,
                            ChainPlaces places, const FacingLimits& limits, FeatureSamples& samples);

}  // namespace fpo
