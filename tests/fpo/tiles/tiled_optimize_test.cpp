#include "fpo/tiles/tiled_optimize.h"

#include <algorithm>
#include <atomic>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/split_facets.h"
#include "tests/fixtures/same_samples.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;

namespace {

struct Run {
  std::vector<SurfaceSample> samples;
  OptimizeResult result;
  std::vector<IterationReport> reports;
  bool operator==(const Run& other) const { return fixtures::same(samples, other.samples); }
};

Run run(const SurfaceTask& task, const TileOptions& tiles, OptimizeOptions options) {
  Run run;
  options.on_iteration = [&](const IterationReport& report) { run.reports.push_back(report); };
  const SurfaceDomain domain = optimize_in_tiles(task, tiles, options, run.result);
  for (std::size_t i = 0; i < domain.num_samples(); ++i) run.samples.push_back(domain.sample(SiteId(i)));
  return run;
}

}  // namespace

TEST_CASE("tiled optimization: any number of threads gives the same samples, each moved once an iteration") {
  const TriMesh mesh = fixtures::blob(9);
  for (const bool adaptive : {false, true}) {
    const Sizing sizing = adaptive ? fixtures::graded(mesh, 0.03, 0.04) : fixtures::even(mesh, 900);
    SurfaceOptions surface;
    surface.num_fixed = 30;
    const SurfaceTask task{mesh, sizing, random_samples(mesh, sizing, 900, 3), surface};
    OptimizeOptions options;
    options.max_iterations = 6;
    options.scope = adaptive ? Scope::two_ring : Scope::global;
    options.order = adaptive ? VisitOrder::shuffled : VisitOrder::in_turn;
    const Run alone = run(task, {200, 4, 1}, options);
    CHECK(alone.result.moves == 6 * (900 - 30));
    CHECK(alone.result.reason == StopReason::iteration_cap);
    CHECK(alone.result.last.iteration == 6);
    CHECK(alone.result.last.delta > alone.reports.front().delta);
    for (std::size_t i = 0; i < 30; ++i) CHECK(alone.samples[i].position == task.samples[i].position);
    for (const int threads : {2, 3, 8}) {
      const Run shared = run(task, {200, 4, threads}, options);
      CHECK(shared == alone);
      CHECK(shared.result.last.delta == alone.result.last.delta);
    }
    OptimizeOptions other = options;
    other.seed = 2;
    CHECK_FALSE(run(task, {200, 4, 1}, other) == alone);
  }
}

TEST_CASE(
    "tiled optimization: the first global iterations are those on the whole surface, reports and reasons "
    "too") {
  const TriMesh mesh = fixtures::blob(9);
  constexpr std::size_t n = 600;
  const Sizing sizing = fixtures::even(mesh, n);
  SurfaceOptions surface;
  surface.num_fixed = 20;
  const SurfaceTask task{mesh, sizing, random_samples(mesh, n, 3), surface};
  const auto on_whole = [&](OptimizeOptions options) {
    Run run;
    options.on_iteration = [&](const IterationReport& report) { run.reports.push_back(report); };
    SurfaceDomain domain(mesh, sizing, task.samples, surface);
    run.result = optimize(domain, options);
    for (std::size_t i = 0; i < n; ++i) run.samples.push_back(domain.sample(SiteId(i)));
    return run;
  };
  const auto check_same = [&](const OptimizeOptions& options) {
    const Run tiled = run(task, {100, 4, 2}, options), whole = on_whole(options);
    CHECK(tiled == whole);
    CHECK(tiled.result.reason == whole.result.reason);
    CHECK(tiled.result.moves == whole.result.moves);
    REQUIRE(tiled.reports.size() == whole.reports.size());
    for (std::size_t i = 0; i < tiled.reports.size(); ++i) {
      CHECK(tiled.reports[i].iteration == whole.reports[i].iteration);
      CHECK(tiled.reports[i].moved == whole.reports[i].moved);
      CHECK(tiled.reports[i].delta == whole.reports[i].delta);
    }
    return tiled.result;
  };
  OptimizeOptions options;
  options.order = VisitOrder::in_turn;
  for (const int most : {1, 2, 3}) {
    options.max_iterations = most;
    CHECK(check_same(options).reason == StopReason::iteration_cap);
  }
  options.max_iterations = 50;
  options.target_delta = 0.6;
  CHECK(check_same(options).reason == StopReason::target_reached);
  options.target_delta = 0.7;
  options.rest_spacing = 0.7;
  options.max_iterations = 2;
  CHECK(check_same(options).moves < 2 * (n - 20));

  OptimizeOptions interrupted;
  interrupted.order = VisitOrder::in_turn;
  std::atomic<bool> stop = false;
  interrupted.interrupted = &stop;
  interrupted.on_move = [&](std::size_t move) { stop = move == 700; };
  const OptimizeResult result = run(task, {100, 4, 2}, interrupted).result;
  CHECK(result.reason == StopReason::interrupted);
  CHECK(result.moves == 701);
  CHECK(result.last.iteration == 2);
}

TEST_CASE("tiled optimization: as good as on the whole surface") {
  const TriMesh mesh = fixtures::blob(9);
  constexpr std::size_t n = 1200;
  const Sizing sizing = fixtures::even(mesh, n);
  const SurfaceOptions surface;
  const auto samples = random_samples(mesh, n, 3);
  for (const Scope scope : {Scope::global, Scope::two_ring}) {
    OptimizeOptions options;
    options.max_iterations = 20;
    options.scope = scope;
    const Run tiled = run({mesh, sizing, samples, surface}, {400, 5, 2}, options);
    SurfaceDomain whole(mesh, sizing, samples, surface);
    const IterationReport last = optimize(whole, options).last;
    CHECK(tiled.result.last.mean_delta > 0.98 * last.mean_delta);
    CHECK(tiled.result.last.delta > 0.85 * last.delta);  // a minimum, which is reached slowly
    SurfaceDomain again(mesh, sizing, tiled.samples, surface);
    CHECK(measure(again).delta == tiled.result.last.delta);
  }
}

TEST_CASE("tiled optimization: an interruption leaves the moves done, and stops at once") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing sizing = fixtures::even(mesh, 400);
  const SurfaceOptions surface;
  const SurfaceTask task{mesh, sizing, random_samples(mesh, 400, 3), surface};
  std::atomic<bool> stop = false;
  OptimizeOptions options;
  options.interrupted = &stop;
  options.on_move = [&](std::size_t move) { stop = move >= 150; };
  const Run interrupted = run(task, {100, 5, 2}, options);
  CHECK(interrupted.result.reason == StopReason::interrupted);
  CHECK(interrupted.result.moves >= 151);
  CHECK(interrupted.result.moves <= 153);
  CHECK_FALSE(fixtures::same(interrupted.samples, task.samples));
}

// What is known of the cells comes from the last round, but not if its facets were others; and when a run is
// interrupted it looks at no cell again. Runs that reach what they are to reach in tiles make no moves after.
TEST_CASE("tiled optimization: the last domain is that of the samples, and knows their cells from a round") {
  constexpr std::size_t n = 500;
  struct Case {
    TriMesh mesh;
    Scope scope;
    bool facets_are_large = false, is_interrupted = false;
  };
  for (const Case& c : {Case{fixtures::blob(9), Scope::two_ring}, Case{fixtures::blob(9), Scope::global},
                        Case{fixtures::box({1, 1, 0.02}, 12), Scope::global},
                        Case{fixtures::box({1, 1, 1}, 1), Scope::global, true},
                        Case{fixtures::blob(9), Scope::two_ring, false, true}}) {
    CAPTURE(c.mesh.num_facets());
    const Sizing sizing = fixtures::even(c.mesh, n);
    REQUIRE(has_long_edges(c.mesh, sizing, 4) == c.facets_are_large);
    const SurfaceOptions surface;
    const SurfaceTask task{c.mesh, sizing, random_samples(c.mesh, n, 3), surface};
    const TileOptions tiles{300, 4, 2};
    OptimizeOptions options;
    options.scope = c.scope;
    options.max_iterations = c.scope == Scope::global ? 3 : 0;  // those on the whole surface
    const OptimizeResult before = run(task, tiles, options).result;
    options.max_iterations = 100;
    options.target_delta = c.is_interrupted ? 1 : before.last.delta;
    std::atomic<bool> stop = false;
    options.interrupted = &stop;
    if (c.is_interrupted) options.on_move = [&](std::size_t move) { stop = move >= n / 2; };
    OptimizeResult result;
    SurfaceDomain domain = optimize_in_tiles(task, tiles, options, result);
    REQUIRE(result.reason == (c.is_interrupted ? StopReason::interrupted : StopReason::target_reached));
    REQUIRE(result.last.iteration > before.last.iteration);
    REQUIRE(result.last.iteration < 100);
    std::size_t known = 0;
    for (SiteId x(0); x.index() < n; x = SiteId(x.value + 1))
      known += domain.dual().known_cell(x).shape != geom::CellShape::unknown;
    CHECK(known == (c.facets_are_large || c.is_interrupted ? 0 : n));
    SurfaceDomain fresh = domain.rebuilt();
    for (SiteId x(0); x.index() < n; x = SiteId(x.value + 1))
      REQUIRE(domain.move(x, Scope::global) == fresh.move(x, Scope::global));
    for (SiteId x(0); x.index() < n; x = SiteId(x.value + 1))
      CHECK(domain.sample(x).position == fresh.sample(x).position);
    domain.check();
  }
}
