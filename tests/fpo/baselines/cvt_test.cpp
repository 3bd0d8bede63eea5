#include "fpo/baselines/cvt.h"

#include <atomic>

#include "doctest.h"
#include "fpo/baselines/cell_moments.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

Sizing even(const TriMesh& mesh, std::size_t n) { return Sizing::uniform(hexagonal_spacing(mesh.area(), n)); }

double cvt_energy(const BaselineTask& task, const std::vector<SurfaceSample>& samples) {
  VoronoiMoments moments(task.surface, task.sizing, 1, 1);
  double sum = 0;
  for (const CellMoments& cell : moments.of(samples)) sum += cell.second;
  return sum;
}

OptimizeOptions iterations(int number) {
  OptimizeOptions options;
  options.max_iterations = number;
  return options;
}

bool same(const std::vector<SurfaceSample>& a, const std::vector<SurfaceSample>& b) {
  return std::ranges::equal(a, b, [](const SurfaceSample& x, const SurfaceSample& y) {
    return x.position == y.position && x.facet == y.facet;
  });
}

}  // namespace

TEST_CASE("cvt: the cvt_energy sinks from iteration to iteration, towards that of hexagons") {
  const TriMesh mesh = geom::make_shape("torus", 60);
  constexpr std::size_t n = 400;
  const Sizing sizing = even(mesh, n);
  const BaselineTask task{mesh, sizing, {}, n, 3, 2};
  // A regular hexagon of area A has the second moment 5 sqrt(3) / 54 A^2.
  const double hexagons = 5 * std::sqrt(3) / 54 * mesh.area() * mesh.area() / n;
  double last = std::numeric_limits<double>::infinity();
  for (const int k : {0, 1, 4, 5, 6, 10, 30, 60}) {
    const double now = cvt_energy(task, centroidal_tessellation(task, iterations(k)).samples);
    CHECK(now < last);
    last = now;
  }
  CHECK(last < 1.015 * hexagons);
  CHECK(last > 0.97 * hexagons);
}

TEST_CASE("cvt: samples are on the surface, as many as wanted; threads do not matter, seeds do") {
  for (const auto& [name, mesh] : fixtures::surfaces()) {
    CAPTURE(name);
    const Sizing sizing = even(mesh, 80);
    const geom::AabbTree tree(mesh);
    const auto run = [&](std::uint64_t seed, int threads) {
      return centroidal_tessellation({mesh, sizing, {}, 80, seed, threads}, iterations(12)).samples;
    };
    const auto samples = run(1, 1);
    REQUIRE(samples.size() == 80);
    for (const SurfaceSample& x : samples)
      CHECK(geom::closest_point(x.position, tree.triangle(x.facet)).distance2 < 1e-24);
    CHECK(same(samples, run(1, 3)));
    CHECK(!same(samples, run(2, 1)));
  }
}

TEST_CASE("cvt: fixed samples stay, and no other comes between neighbours on a crease") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  constexpr std::size_t n = 300;
  const Sizing sizing = even(mesh, n);
  std::vector<SurfaceSample> fixed;  // along two edges of the cube
  for (int i = 0; i <= 7; ++i) {
    fixed.push_back({Vec3(i / 7.0, 0, 0), geom::FacetId(0)});
    if (i > 0) fixed.push_back({Vec3(0, i / 7.0, 0), geom::FacetId(0)});
  }
  const auto samples = centroidal_tessellation({mesh, sizing, fixed, n, 1, 2}, iterations(40)).samples;
  REQUIRE(samples.size() == n);
  CHECK(same(fixed, {samples.begin(), samples.begin() + std::ssize(fixed)}));
  for (std::size_t i = fixed.size(); i < n; ++i)
    for (const SurfaceSample& x : fixed)
      CHECK((x.position - samples[i].position).norm() > 0.6 * sizing.at(x));
  CHECK(
      same(fixed, centroidal_tessellation({mesh, sizing, fixed, fixed.size(), 1, 2}, iterations(3)).samples));
}

TEST_CASE("cvt: interrupted, it keeps what it has") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing sizing = even(mesh, 100);
  const BaselineTask task{mesh, sizing, {}, 100, 1, 1};
  std::atomic<bool> stop = false;
  OptimizeOptions options = iterations(1000);
  options.interrupted = &stop;
  options.on_iteration = [&](const IterationReport& r) { stop = r.iteration >= 7; };
  const BaselineResult result = centroidal_tessellation(task, options);
  CHECK(result.run.reason == StopReason::interrupted);
  CHECK(result.run.last.iteration == 7);
  CHECK(same(result.samples, centroidal_tessellation(task, iterations(7)).samples));
}
