#include "fpo/remesh/start.h"

#include <algorithm>

#include "fpo/remesh/small_parts.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/scaling.h"

namespace fpo {

std::vector<SurfaceSample> initial_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                           std::size_t n, std::uint64_t seed) {
  std::vector<SurfaceSample> samples = shared.features.samples;
  if (samples.size() < n) {
    const std::vector<SurfaceSample> inner = random_samples(surface, shared.sizing, n - samples.size(), seed);
    samples.insert(samples.end(), inner.begin(), inner.end());
    if (shared.has_small_parts)
      SmallParts(surface).people(shared.sizing, shared.features.samples.size(), samples);
  }
  for (SurfaceSample& x : samples) x.position = geom::snapped(x.position);
  return samples;
}

void take_inner(const std::vector<SurfaceSample>& from, std::size_t fixed_there, std::size_t fixed,
                std::vector<SurfaceSample>& samples) {
  const std::size_t some = std::min(samples.size() - std::min(fixed, samples.size()),
                                    from.size() - std::min(fixed_there, from.size()));
  for (std::size_t i = 0; i < some; ++i) samples[fixed + i] = from[fixed_there + i];
}

}  // namespace fpo
