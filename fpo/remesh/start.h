#pragma once
// The samples that a remesh begins with (paper, section 4.2: random ones).

#include <cstdint>
#include <vector>

#include "fpo/features/feature_samples.h"

namespace fpo {

/// Those on features, which stay, then random ones, up to n, some of them brought to small components
/// (small_parts.h); all in the exact range of the predicates, like
/// the surface.
std::vector<SurfaceSample> initial_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                           std::size_t n, std::uint64_t seed);

/// Puts the inner ones of `from`, which follow its first `fixed_there`, in the place of those that follow the
/// first `fixed` samples: as many as there are of both.
void take_inner(const std::vector<SurfaceSample>& from, std::size_t fixed_there, std::size_t fixed,
                std::vector<SurfaceSample>& samples);

}  // namespace fpo
