#include "fpo/rest.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/plane/plane_domain.h"
#include "fpo/surface/surface_domain.h"
#include "fpo/tiles/tiled_optimize.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;

namespace {

SurfaceDomain sphere_domain(const geom::TriMesh& mesh, std::size_t n) {
  return SurfaceDomain(mesh, random_samples(mesh, n, 5));
}

std::vector<SiteId> all(std::size_t n) {
  std::vector<SiteId> samples;
  for (std::size_t i = n; i > 0; --i) samples.emplace_back(i - 1);
  return samples;
}

}  // namespace

TEST_CASE("rest: who has the spacing, and neighbours that have it, rests") {
  const geom::TriMesh mesh = fixtures::blob(9);
  SurfaceDomain domain = sphere_domain(mesh, 200);
  for (int i = 0; i < 400; ++i) domain.move(SiteId(i % 200), Scope::global);
  const double spacing = measure(domain).mean_delta;
  const std::vector<SiteId> samples = all(200), awake = restless(domain, samples, spacing);
  CHECK(!awake.empty());
  CHECK(awake.size() < samples.size());
  CHECK(std::ranges::is_sorted(awake, std::greater()));  // the order given
  std::vector<SiteId> around;
  for (const SiteId x : samples) {
    domain.neighbours(x, around);
    around.push_back(x);
    const bool near_short =
        std::ranges::any_of(around, [&](SiteId y) { return domain.normalized_spacing(y) < spacing; });
    CHECK(std::ranges::count(awake, x) == (near_short ? 1 : 0));
  }
  CHECK(restless(domain, samples, no_rest) == samples);
  CHECK(restless(domain, samples, 0).empty());
}

TEST_CASE("rest: a goal is reached with fewer moves") {
  const geom::TriMesh mesh = fixtures::blob(16);
  for (const double goal : {0.85, 0.88}) {
    OptimizeOptions options;
    options.target_delta = goal;
    SurfaceDomain plain = sphere_domain(mesh, 600), resting = sphere_domain(mesh, 600);
    const OptimizeResult without = optimize(plain, options);
    options.rest_spacing = goal + rest_margin;
    const OptimizeResult with = optimize(resting, options);
    REQUIRE(without.reason == StopReason::target_reached);
    REQUIRE(with.reason == StopReason::target_reached);
    CHECK(measure(resting).delta > goal);
    CHECK(with.moves < without.moves);
    resting.check();
  }
}

TEST_CASE("rest: in tiles, with any number of threads alike") {
  const geom::TriMesh mesh = fixtures::blob(16);
  const Sizing sizing = fixtures::even(mesh, 1500);
  const SurfaceOptions surface;
  OptimizeOptions options;
  options.target_delta = 0.85;
  options.rest_spacing = options.target_delta + rest_margin;
  std::vector<geom::Vec3> first;
  for (const int threads : {1, 3}) {
    TileOptions tiles;
    tiles.most_samples = 400;
    tiles.threads = threads;
    OptimizeResult result;
    const SurfaceDomain domain =
        optimize_in_tiles({mesh, sizing, random_samples(mesh, 1500, 2), surface}, tiles, options, result);
    CHECK(result.reason == StopReason::target_reached);
    CHECK(result.last.delta > options.target_delta);
    CHECK(result.moves < 1500u * static_cast<std::size_t>(result.last.iteration));
    std::vector<geom::Vec3> places;
    for (std::size_t i = 0; i < domain.num_samples(); ++i)
      places.push_back(domain.sample(SiteId(i)).position);
    if (first.empty()) first = places;
    CHECK(places == first);
  }
}
