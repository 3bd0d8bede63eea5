#include "fpo/baselines/cvt.h"

#include "doctest.h"
#include "fpo/baselines/cell_moments.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/baselines.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using fixtures::iterations;
using geom::TriMesh;
using geom::Vec3;

namespace {

double cvt_energy(const BaselineTask& task, const std::vector<SurfaceSample>& samples) {
  VoronoiMoments moments(task.surface, task.sizing, 1, 1);
  double sum = 0;
  for (const CellMoments& cell : moments.of(samples)) sum += cell.second;
  return sum;
}

}  // namespace

TEST_CASE("cvt: the cvt_energy sinks from iteration to iteration, towards that of hexagons") {
  const TriMesh mesh = geom::make_shape("torus", 60);
  constexpr std::size_t n = 400;
  const Sizing sizing = fixtures::even(mesh, n);
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
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const Sizing sizing = fixtures::even(mesh, 80);
    fixtures::check_samples(centroidal_tessellation, mesh, sizing, 12);
  }
}

TEST_CASE("cvt: fixed samples stay, and no other comes between neighbours on a crease") {
  const TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 1);
  constexpr std::size_t n = 300;
  const Sizing sizing = fixtures::even(mesh, n);
  std::vector<SurfaceSample> fixed;  // along two edges of the cube
  for (int i = 0; i <= 7; ++i) {
    fixed.push_back({Vec3(i / 7.0, 0, 0), geom::FacetId(0)});
    if (i > 0) fixed.push_back({Vec3(0, i / 7.0, 0), geom::FacetId(0)});
  }
  const auto samples = centroidal_tessellation({mesh, sizing, fixed, n, 1, 2}, iterations(40)).samples;
  REQUIRE(samples.size() == n);
  CHECK(fixtures::same(fixed, {samples.begin(), samples.begin() + std::ssize(fixed)}));
  for (std::size_t i = fixed.size(); i < n; ++i)
    for (const SurfaceSample& x : fixed)
      CHECK((x.position - samples[i].position).norm() > 0.6 * sizing.at(x));
  CHECK(fixtures::same(
      fixed, centroidal_tessellation({mesh, sizing, fixed, fixed.size(), 1, 2}, iterations(3)).samples));
}

TEST_CASE("cvt: interrupted, it keeps what it has") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing sizing = fixtures::even(mesh, 100);
  fixtures::check_interruption(centroidal_tessellation, {mesh, sizing, {}, 100, 1, 1}, 7);
}
