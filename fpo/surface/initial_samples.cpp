#include "fpo/surface/initial_samples.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/rng.h"

namespace fpo {

using geom::TriMesh;
using geom::Vec2;

namespace {

constexpr int most_draws = 64;

/// Density proportional to h^-2 by rejection: on nearly all patches at most one draw in three fails. On those
/// where h varies much, which are far smaller than the spacing elsewhere on them, the last draw will do.
SurfaceSample draw_in(const SizedPatch& patch, const TriMesh& mesh, const Sizing& sizing, geom::Rng& rng) {
  for (int draws = 1;; ++draws) {
    // Turning the root of a uniform number into the distance from corner 0 makes the density constant.
    const double r = std::sqrt(rng.uniform()), s = rng.uniform();
    const Vec2 at = patch.corners[0] + r * (1 - s) * (patch.corners[1] - patch.corners[0]) +
                    r * s * (patch.corners[2] - patch.corners[0]);
    const SurfaceSample sample = location_in_facet(mesh, patch.facet, at.x(), at.y());
    if (sizing.is_uniform()) return sample;
    const double share = patch.least_h / sizing.at(sample);
    if (rng.uniform() < share * share || draws == most_draws) return sample;
  }
}

}  // namespace

std::vector<SurfaceSample> random_samples(const TriMesh& mesh, const Sizing& sizing, std::size_t n,
                                          std::uint64_t seed) {
  geom::require(n > 0, "the number of samples must be at least 1");
  geom::require(n <= max_samples, "the number of samples must be at most " + std::to_string(max_samples));
  const std::vector<SizedPatch> patches = sized_patches(mesh, sizing);
  std::vector<double> mass_up_to;
  mass_up_to.reserve(patches.size());
  double total = 0;
  for (const SizedPatch& patch : patches) mass_up_to.push_back(total += patch.num_samples);
  geom::require(total > 0 && std::isfinite(total), "the surface has no area to sample");

  geom::Rng rng(seed);
  std::vector<SurfaceSample> samples;
  samples.reserve(n);
  while (samples.size() < n) {
    // The first patch whose cumulated mass exceeds the draw has positive mass.
    const auto pick =
        std::min(std::ranges::upper_bound(mass_up_to, rng.uniform() * total), mass_up_to.end() - 1);
    samples.push_back(
        draw_in(patches[static_cast<std::size_t>(pick - mass_up_to.begin())], mesh, sizing, rng));
  }
  return samples;
}

std::vector<SurfaceSample> random_samples(const TriMesh& mesh, std::size_t n, std::uint64_t seed) {
  return random_samples(mesh, Sizing::uniform(1), n, seed);
}

}  // namespace fpo
