#pragma once
// Weights that empty the balls of edges on curves (cf. Cheng, Dey, Ramos 2010). Where a sample that is not on
// the curve is in the ball that proves an edge (proven_edges.h), some more weight at both ends takes it out:
// the ball stays where it is and becomes smaller in power. Where lengths differ that is a few percent, for
// optimization keeps samples no farther apart than about .7 wanted lengths there, and samples that slide may
// come as near.

#include <atomic>
#include <cstddef>

#include "fpo/features/feature_samples.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

/// Raises weights at the ends of the edges that are not proven, by what they lack, to 1.5 times the usual
/// ones at most, and again for edges that this opens, up to ten times, as long as fewer and fewer are open;
/// what does not make them fewer is undone. The number of samples with another weight. Changes nothing if all
/// edges are proven. The features are those of the domain's mesh, their samples its fixed ones, its first.
/// Deterministic. Cost: that of num_proven_edges() a round.
std::size_t empty_balls(SurfaceDomain& domain, const Features& features, const FeatureSamples& samples);

/// What is too deep in a ball for that, where the border juts out beside an edge of its curve, say: the
/// deepest one leaves for the farthest point of all, if it is not fixed, and those around it follow. As long
/// as that leaves fewer edges open, in some fifty trials at most; else it is undone. How many left. Nothing
/// changes if all edges are proven. As above; a trial costs O(n) and some moves more.
std::size_t send_out_of_balls(SurfaceDomain& domain, const Features& features, const FeatureSamples& samples,
                              const std::atomic<bool>* interrupted);

}  // namespace fpo
