#include "fpo/initial_samples.h"

#include <algorithm>
#include <cmath>

#include "geom/check.h"
#include "geom/rng.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr std::size_t max_samples = 20'000'000;  // ids and memory: about 1 KB a sample

}  // namespace

// q0 + u (q1 - q0) + v (q2 - q0), kept inside the facet's box against rounding.
Vec3 location_in_facet(const TriMesh& mesh, FacetId t, double u, double v) {
  const Vec3 &q0 = mesh.corner(t, 0), &q1 = mesh.corner(t, 1), &q2 = mesh.corner(t, 2);
  const Vec3 x = q0 + u * (q1 - q0) + v * (q2 - q0);
  return x.cwiseMax(q0.cwiseMin(q1).cwiseMin(q2)).cwiseMin(q0.cwiseMax(q1).cwiseMax(q2));
}

std::vector<SurfaceSample> random_samples(const TriMesh& mesh, std::size_t n, std::uint64_t seed) {
  geom::require(n > 0, "the number of samples must be at least 1");
  geom::require(n <= max_samples, "the number of samples must be at most " + std::to_string(max_samples));
  std::vector<double> area_up_to;
  area_up_to.reserve(mesh.num_facets());
  double total = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    area_up_to.push_back(total += mesh.area(t));
  geom::require(total > 0 && std::isfinite(total), "the surface has no area to sample");

  geom::Rng rng(seed);
  std::vector<SurfaceSample> samples;
  samples.reserve(n);
  while (samples.size() < n) {
    // The first facet whose cumulated area exceeds the draw has positive area.
    const auto pick = std::ranges::upper_bound(area_up_to, rng.uniform() * total);
    const FacetId t(static_cast<std::size_t>(std::min(pick, area_up_to.end() - 1) - area_up_to.begin()));
    // Turning the root of a uniform number into the distance from corner 0 makes the density constant.
    const double r = std::sqrt(rng.uniform()), s = rng.uniform();
    samples.push_back({location_in_facet(mesh, t, r * (1 - s), r * s), t});
  }
  return samples;
}

}  // namespace fpo
