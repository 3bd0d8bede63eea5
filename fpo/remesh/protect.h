#pragma once
// Feature curves as chains of edges of the remesh (paper, section 5, where even spacing along curves is to
// suffice). It does not where other samples come between two neighbours on a curve: where sheets are closer
// than the spacing, or with few samples. There samples on curves get protecting weights: their disks, in
// which they beat any sample of the usual weight, cover the edge between them (cf. Cheng, Dey, Ramos 2010).

#include <atomic>
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

/// Mends the chain edges that the RRT lacks. Where samples of features are closer to each other than half
/// the wanted length, their weights become those of twice the distance, for weights of wanted lengths may
/// differ by more than the squares of distances there. Elsewhere the weights of both ends are raised by
/// the square of half the edge, to eight times the usual one at most; what would leave another sample of the
/// features hardly its own place is taken back. Where neither can be done the inner sample nearest to the
/// edge's middle moves to the farthest point of the surface. Repeats that, up to ten times, while edges are
/// missing and two times have not brought one back. Nothing changes if none is. The features' samples must be
/// the fixed ones of the domain. Deterministic. O(features) a round, and O(features^2) if an edge is missing,
/// once more each time that one taken back takes others with it. Looks before each edge whether it is
/// `interrupted`.
Protection protect_chains(SurfaceDomain& domain, const FeatureSamples& features,
                          const std::atomic<bool>* interrupted = nullptr);

}  // namespace fpo
