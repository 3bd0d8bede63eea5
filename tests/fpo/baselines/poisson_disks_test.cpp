// Maximal, constrained, parallel and hierarchical Poisson-disk sampling (mps, cps, pps, hps) against their
// definitions.

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "doctest.h"
#include "fpo/baselines/cps.h"
#include "fpo/baselines/hps.h"
#include "fpo/baselines/mps.h"
#include "fpo/baselines/pps.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/surface_domain.h"
#include "geom/check.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// At most so many are tried.
OptimizeOptions radii(int most) {
  OptimizeOptions options;
  options.max_iterations = most;
  return options;
}

constexpr std::array all_methods{maximal_poisson_disks, constrained_poisson_disks, parallel_poisson_disks,
                                 hierarchical_poisson_disks};

/// No sample is in the disk of an earlier one.
void check_distances(const BaselineResult& result, const Sizing& sizing, std::size_t num_fixed) {
  double least = std::numeric_limits<double>::infinity();  // distance over radius
  for (std::size_t j = 0; j < result.samples.size(); ++j) {
    const double radius = result.radius_factor * sizing.at(result.samples[j]);
    for (std::size_t i = std::max(j + 1, num_fixed); i < result.samples.size(); ++i)
      least = std::min(least, (result.samples[i].position - result.samples[j].position).norm() / radius);
  }
  CHECK(least > 1 - 1e-12);
}

/// The largest power of the surface to the disks, from the circles of all types of another diagram.
double largest_gap(const TriMesh& mesh, const Sizing& sizing, const BaselineResult& result) {
  SurfaceOptions options;
  options.weight_factor = result.radius_factor;
  options.corners = geom::CornerTypes::all;
  SurfaceDomain domain(mesh, sizing, result.samples, options);
  const double radius = sizing.is_uniform() ? result.radius_factor * sizing.at(result.samples[0]) : 0;
  return domain.largest_empty(Scope::global).radius2 - radius * radius;  // equal weights are left out there
}

}  // namespace

TEST_CASE("mps: disks keep their distance and cover every surface, borders and tips included") {
  for (const auto& surface : fixtures::surfaces())
    for (const bool adaptive : {false, true})
      for (const std::size_t n : {12, 250}) {
        CAPTURE(surface.name);
        CAPTURE(adaptive);
        CAPTURE(n);
        const Sizing sizing = fixtures::even_or_graded(surface.mesh, n, adaptive);
        const BaselineResult result = maximal_poisson_disks({surface.mesh, sizing, {}, n, 5, 1}, radii(2));
        check_distances(result, sizing, 0);
        CHECK(largest_gap(surface.mesh, sizing, result) <= 1e-12 * surface.mesh.area());
        // By brute force too.
        for (const SurfaceSample& x : random_samples(surface.mesh, 300, 9))
          CHECK(std::ranges::any_of(result.samples, [&](const SurfaceSample& y) {
            return (x.position - y.position).norm() <= result.radius_factor * sizing.at(y) * (1 + 1e-9);
          }));
      }
}

TEST_CASE("cps: the samples are those that elimination in a list leaves") {
  for (const auto& surface : fixtures::surfaces())
    for (const bool adaptive : {false, true}) {
      CAPTURE(surface.name);
      const Sizing sizing = fixtures::even_or_graded(surface.mesh, 60, adaptive);
      const BaselineResult result = constrained_poisson_disks({surface.mesh, sizing, {}, 60, 3, 1}, radii(3));
      check_distances(result, sizing, 0);
      std::vector<SurfaceSample> left = random_samples(surface.mesh, sizing, 15 * 60, 3);
      for (const SurfaceSample& x : result.samples) {
        REQUIRE(!left.empty());
        CHECK(left.front().position == x.position);
        const double radius = result.radius_factor * sizing.at(left.front());
        std::erase_if(left, [&, at = left.front().position](const SurfaceSample& y) {
          return (y.position - at).norm() <= radius;
        });
      }
      CHECK(left.empty());
    }
}

TEST_CASE("hps: disks keep their distance and cover every surface, borders and tips included") {
  for (const auto& surface : fixtures::surfaces())
    for (const bool adaptive : {false, true}) {
      CAPTURE(surface.name);
      CAPTURE(adaptive);
      const Sizing sizing = fixtures::even_or_graded(surface.mesh, 120, adaptive);
      const BaselineResult result =
          hierarchical_poisson_disks({surface.mesh, sizing, {}, 120, 5, 1}, radii(2));
      check_distances(result, sizing, 0);
      CHECK(result.reached.front().value == 0);  // triangles that were given up
      CHECK(largest_gap(surface.mesh, sizing, result) <= 1e-9 * surface.mesh.area());
    }
}

TEST_CASE("pps: disks keep their distance, and no candidate is left free, with any number of threads") {
  for (const auto& surface : fixtures::surfaces())
    for (const bool adaptive : {false, true}) {
      CAPTURE(surface.name);
      CAPTURE(adaptive);
      const Sizing sizing = fixtures::even_or_graded(surface.mesh, 60, adaptive);
      const auto run = [&](int threads) {
        return parallel_poisson_disks({surface.mesh, sizing, {}, 60, 3, threads}, radii(2));
      };
      const BaselineResult result = run(1), other = run(3);
      check_distances(result, sizing, 0);
      const auto cloud =
          random_samples(surface.mesh, sizing, static_cast<std::size_t>(result.reached.front().value), 3);
      for (std::size_t i = 0; i < cloud.size(); i += 7)
        CHECK(std::ranges::any_of(result.samples, [&](const SurfaceSample& y) {
          return (cloud[i].position - y.position).norm() <= result.radius_factor * sizing.at(y) * (1 + 1e-12);
        }));
      CHECK(std::ranges::equal(result.samples, other.samples,
                               [](const auto& x, const auto& y) { return x.position == y.position; }));
    }
}

TEST_CASE("poisson disks: about the number wanted; fixed samples come first; one seed, one result") {
  const TriMesh mesh = fixtures::blob(8);
  constexpr std::size_t n = 200;
  for (const auto method : all_methods)
    for (const bool adaptive : {false, true}) {
      const Sizing sizing = fixtures::even_or_graded(mesh, n, adaptive);
      const auto fixed = random_samples(mesh, sizing, 5, 77);
      const auto run = [&](std::uint64_t seed) {
        return method({mesh, sizing, fixed, n, seed, 1}, radii(8));
      };
      const BaselineResult a = run(1), b = run(1), c = run(2);
      CHECK(std::abs(double(a.samples.size()) - double(n)) <= 4);
      check_distances(a, sizing, fixed.size());
      for (std::size_t i = 0; i < fixed.size(); ++i) CHECK(a.samples[i].position == fixed[i].position);
      const auto same = [](const SurfaceSample& x, const SurfaceSample& y) {
        return x.position == y.position;
      };
      CHECK(std::ranges::equal(a.samples, b.samples, same));
      CHECK(!std::ranges::equal(a.samples, c.samples, same));
      const BaselineTask all_fixed{mesh, sizing, fixed, fixed.size(), 1, 1};
      CHECK(method(all_fixed, {}).samples.size() == fixed.size());
    }
}

TEST_CASE("poisson disks: interrupted in the first set of disks, there is no result") {
  const TriMesh mesh = fixtures::blob(8);
  const Sizing sizing = fixtures::even_or_graded(mesh, 500, false);
  for (const auto method : all_methods) {
    std::atomic<bool> stop = true;
    OptimizeOptions options;
    options.interrupted = &stop;
    CHECK_THROWS_AS(method({mesh, sizing, {}, 500, 1, 1}, options), geom::Interrupted);
  }
}
