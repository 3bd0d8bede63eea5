#include "fpo/remesh/maximal.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "doctest.h"
#include "fpo/measure/covering.h"
#include "fpo/optimize.h"
#include "fpo/surface/surface_domain.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// After some iterations of farthest point optimization with the local search.
std::vector<SurfaceSample> optimized(const TriMesh& mesh, const Sizing& sizing, std::size_t n) {
  SurfaceDomain domain(mesh, sizing, random_samples(mesh, sizing, n, 3));
  OptimizeOptions options;
  options.max_iterations = 8;
  options.scope = Scope::two_ring;
  optimize(domain, options);
  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < n; ++i) samples.push_back(domain.sample(SiteId(i)));
  return samples;
}

double least_spacing(const std::vector<SurfaceSample>& samples, const Sizing& sizing) {
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceSample& x : samples)
    for (const SurfaceSample& y : samples)
      if (&x != &y) least = std::min(least, (x.position - y.position).norm() / sizing.at(x));
  return least;
}

}  // namespace

TEST_CASE("maximal: by brute force the disks cover the surface, and the least spacing is no smaller") {
  for (const auto& surface : fixtures::surfaces())
    for (const bool adaptive : {false, true}) {
      CAPTURE(surface.name);
      CAPTURE(adaptive);
      constexpr std::size_t n = 150;
      const Sizing sizing = fixtures::even_or_graded(surface.mesh, n, adaptive);
      std::vector<SurfaceSample> samples = optimized(surface.mesh, sizing, n);
      const double least_before = least_spacing(samples, sizing);
      CHECK(make_maximal(surface.mesh, sizing, samples).maximal);
      REQUIRE(samples.size() == n);
      CHECK(least_spacing(samples, sizing) >= least_before);
      std::vector<Vec3> positions;
      for (const SurfaceSample& x : samples) positions.push_back(x.position);
      const std::vector<double> distances = nearest_distances(positions);
      const Covering found = covering(surface.mesh, positions, distances, 1);
      CHECK((adaptive ? found.local_ratio : found.ratio) <= 1 + 1e-8);
      const double least = *std::ranges::min_element(distances);
      for (const SurfaceSample& x : random_samples(surface.mesh, 500, 9)) {
        bool covered = false;
        for (std::size_t i = 0; i < n; ++i)
          covered |= (x.position - positions[i]).norm() <= (adaptive ? distances[i] : least) * (1 + 1e-8);
        CHECK(covered);
      }
    }
}

TEST_CASE("maximal: a maximal set stays as it is; fixed samples stay; interrupted, nothing is lost") {
  const TriMesh mesh = fixtures::blob(8);
  const Sizing sizing = fixtures::even_or_graded(mesh, 200, true);
  std::vector<SurfaceSample> samples = optimized(mesh, sizing, 200);
  const std::vector<SurfaceSample> before = samples;
  std::atomic<bool> stop = true;
  CHECK(!make_maximal(mesh, sizing, samples, {.interrupted = &stop}).maximal);
  make_maximal(mesh, sizing, samples, {.num_fixed = 20});
  for (std::size_t i = 0; i < 20; ++i) CHECK(samples[i].position == before[i].position);
  std::vector<SurfaceSample> by_three = samples;
  make_maximal(mesh, sizing, samples);
  make_maximal(mesh, sizing, by_three, {.threads = 3});
  for (std::size_t i = 0; i < samples.size(); ++i) CHECK(samples[i].position == by_three[i].position);
  const MaximalResult again = make_maximal(mesh, sizing, samples);
  CHECK(again.maximal);
  CHECK(again.moves == 0);
}
