#pragma once
// Feature curves as chains of edges of the remesh (paper, section 5, where even spacing along curves is to
// suffice). It does not where other samples come between two neighbours on a curve: where sheets are closer
// than the spacing, or with few samples. There samples on curves get protecting weights: their disks, in
// which they beat any sample of the usual weight, cover the edge between them (cf. Cheng, Dey, Ramos 2010).

#include <cstddef>

#include "fpo/features/feature_samples.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

struct Protection {
  std::size_t weighted = 0;  ///< samples given a larger weight
  std::size_t moved = 0;     ///< inner samples taken away from an edge
  Protection& operator+=(const Protection& other) {
    weighted += other.weighted, moved += other.moved;
    return *this;
  }
};

/// Mends the chain edges that the RRT lacks: raises the weights of both ends by the square of half the edge,
/// to eight times the usual one at most;
/// if that is done already, moves the inner sample nearest to the edge's middle to the farthest point of the
/// surface. Repeats that, up to ten times, while edges are missing. Nothing changes if none is. The features'
/// samples must be the fixed ones of the domain. Deterministic. O(features) a round.
Protection protect_chains(SurfaceDomain& domain, const FeatureSamples& features);

}  // namespace fpo
