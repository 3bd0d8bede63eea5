#pragma once
// Edges of feature curves that are proven to be edges of the remesh. Where the curve passes from the cell of
// one sample to that of the next, the ball that has both on its border (in power) holds no other sample: then
// the place is on the border of their two cells, and the edge is one of the restricted regular triangulation
// (cf. the protecting balls of Cheng, Dey, Ramos 2010). Flips (recovered_edges.h) may make others.

#include <cstddef>
#include <vector>

#include "fpo/features/feature_samples.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

/// A chain edge that is not proven.
struct OpenBall {
  SiteId a, b;
  double lack = 0;  ///< the power that both need more for the ball to be empty, about; infinite: none does
  SiteId deepest;   ///< of the samples in the ball, if there is a place between a and b
};

/// Those, in the order of the chains. Cost: that of num_proven_edges().
std::vector<OpenBall> open_balls(const SurfaceDomain& domain, const Features& features,
                                 const FeatureSamples& samples);

/// The number of chain edges of which, on a mesh edge of their curve, the place that is as far in power from
/// both ends is in nobody else's cell. The features are those of the domain's mesh, their samples its first
/// ones. Exact in the stored doubles, ties by the ids (clip_predicates.h). Cost: of each curve the chain
/// edges times the mesh edges, and a search for each chain edge.
std::size_t num_proven_edges(const SurfaceDomain& domain, const Features& features,
                             const FeatureSamples& samples);

}  // namespace fpo
