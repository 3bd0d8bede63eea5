#pragma once
// Maximal sets at the same number of samples (paper, section 6, "Relationship with MPS", leaves them open).
//
// Uniform farthest point optimization ends with a maximal Poisson-disk set, adaptive not always: the farthest
// point is looked for nearby, and sizes change between a sample and its neighbours. Here samples go on moving
// until their disks cover the surface. A sample's disk reaches to the nearest other sample; if the sizing is
// uniform, all disks have the radius of the smallest one.

#include <atomic>

#include "fpo/surface/sizing.h"
#include "fpo/surface/surface_domain.h"

namespace fpo {

struct MaximalOptions {
  std::size_t num_fixed = 0;  ///< the samples before stay where they are
  int threads = 1;            ///< no matter to the result
  const std::atomic<bool>* interrupted = nullptr;
};

struct MaximalResult {
  std::size_t moves = 0;
  int rounds = 0;        ///< a diagram each
  bool maximal = false;  ///< else interrupted, or no sample is better off in a gap
};

/// Moves the sample that is nearest to another, in units of h, to where the surface is farthest out of all
/// disks, again and again until the disks cover it. In a round gaps that are far from each other are filled
/// at once. As a sample in a gap is in no disk, no disk shrinks; and a sample moves only if it gains. So the
/// ascending list of distances over h grows from move to move, and there is an end. Cost: some diagrams.
/// Deterministic. Samples must not coincide.
MaximalResult make_maximal(const geom::TriMesh& mesh, const Sizing& sizing,
                           std::vector<SurfaceSample>& samples, const MaximalOptions& options = {});

/// The same for the samples of a domain. Those that do not move keep their weights.
MaximalResult make_maximal(SurfaceDomain& domain, const MaximalOptions& options);

}  // namespace fpo
