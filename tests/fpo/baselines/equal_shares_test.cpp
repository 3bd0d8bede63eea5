// Variational blue noise (vbs) and capacity-constrained triangulation (ccst): shares of the surface that
// become equal.

#include <algorithm>
#include <array>
#include <cmath>

#include "doctest.h"
#include "fpo/baselines/capacities.h"
#include "fpo/baselines/ccst.h"
#include "fpo/baselines/vbs.h"
#include "fpo/measure/quality.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/baselines.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr std::array both{variational_blue_noise, capacity_constrained_triangulation};

double variation(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double x : values) sum += x, squares += x * x;
  const double n = static_cast<double>(values.size());
  return std::sqrt(squares / n - sum * sum / (n * n)) / (sum / n);
}

}  // namespace

TEST_CASE("vbs: the energy sinks from iteration to iteration, and capacities become equal") {
  const TriMesh mesh = fixtures::blob(6);
  for (const bool adaptive : {false, true}) {
    constexpr std::size_t n = 200;
    const Sizing sizing = fixtures::even_or_graded(mesh, n, adaptive);
    const BaselineTask task{mesh, sizing, {}, n, 3, 2};
    Capacities capacities(mesh, sizing, hexagonal_spacing(mesh.area(), n), 1);
    double last_energy = std::numeric_limits<double>::infinity(), last_variation = last_energy;
    for (const int k : {0, 5, 15, 40}) {
      const BaselineResult result = variational_blue_noise(task, fixtures::iterations(k));
      const auto diagram = capacities.of(result.samples);
      std::vector<double> shares;
      double energy = 0, mean = 0;
      for (const CellCapacity& cell : diagram.cells) mean += cell.capacity / n;
      for (const CellCapacity& cell : diagram.cells) {
        shares.push_back(cell.capacity);
        energy += cell.second + capacity_weight * (cell.capacity - mean) * (cell.capacity - mean);
      }
      CHECK(energy < last_energy);
      if (k < 40) CHECK(variation(shares) < last_variation);
      CHECK(result.reached.front().value == doctest::Approx(variation(shares)).epsilon(1e-6));
      last_energy = energy, last_variation = variation(shares);
    }
    CHECK(last_variation < 0.02);
  }
}

TEST_CASE("ccst: the triangles of the remesh become equal, and it says how equal they are") {
  const TriMesh mesh = fixtures::blob(10);
  double last = std::numeric_limits<double>::infinity();
  for (const int k : {0, 2, 8, 40}) {
    RemeshOptions options;
    options.method = Method::ccst;
    options.num_samples = 300;
    options.optimize.max_iterations = k;
    options.optimize_angles = options.improve_fidelity = false;
    const RemeshResult result = remesh(mesh, options);
    std::vector<double> areas;
    for (FacetId t(0); t.index() < result.mesh.num_facets(); t = FacetId(t.value + 1))
      areas.push_back(result.mesh.area(t));
    CHECK(variation(areas) < last);
    if (result.brought == 0)
      CHECK(result.reached.front().value == doctest::Approx(variation(areas)).epsilon(1e-6));
    last = variation(areas);
  }
  CHECK(last < 0.06);
}

TEST_CASE("vbs, ccst: samples are on the surface, as many as wanted; threads do not matter, seeds do") {
  for (const auto& surface : fixtures::surfaces())
    for (const bool adaptive : {false, true})
      for (const auto method : both) {
        CAPTURE(surface.name);
        const Sizing sizing = fixtures::even_or_graded(surface.mesh, 80, adaptive);
        fixtures::check_samples(method, surface.mesh, sizing, 8);
      }
}

TEST_CASE("vbs, ccst: fixed samples stay; interrupted, they keep what they have") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing sizing = fixtures::even_or_graded(mesh, 100, false);
  const std::vector<SurfaceSample> fixed = random_samples(mesh, sizing, 4, 9);
  for (const auto method : both) fixtures::check_interruption(method, {mesh, sizing, fixed, 100, 1, 1}, 3);
}

TEST_CASE("vbs: half cells on a border leave the cells inside equal") {
  const TriMesh mesh = fixtures::tilted_square(2);
  for (const std::size_t n : {10, 40}) {
    RemeshOptions options = default_options(n, SizingKind::uniform);
    use_method(options, Method::vbs);
    const RemeshResult result = remesh(mesh, options);
    CHECK(result.feature_samples > n / 3);
    CHECK(result.reached.back().value < 0.02);  // with half cells among the equal ones .3
    CHECK(quality(result.mesh, mesh.area()).theta_min > 5);
  }
}

TEST_CASE("vbs: the parts between creases begin with equal shares, so no row is pressed against a crease") {
  RemeshOptions options = default_options(800, SizingKind::uniform);
  use_method(options, Method::vbs);
  options.features = automatic_features();
  const RemeshResult result = remesh(geom::make_shape("cube", 4), options);
  CHECK(result.feature_samples > 100);
  CHECK(result.reached.back().value < 0.01);     // from random samples .048
  CHECK(quality(result.mesh, 1.0).q_avg > 0.8);  // .68
}
