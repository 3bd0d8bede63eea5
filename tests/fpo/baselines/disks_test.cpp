#include "fpo/baselines/disks.h"

#include <atomic>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::Vec3;

TEST_CASE("disks: free is what a search through all disks says") {
  const geom::TriMesh mesh = fixtures::blob(5);
  VertexField h;
  for (const Vec3& p : mesh.vertices()) h.push_back(0.2 + 0.1 * p.x());
  const Sizing sizing(mesh, std::move(h));
  Disks disks(sizing, 0.8);
  CHECK(disks.is_free(Vec3(0, 0, 0)));
  std::size_t num_free = 0;
  for (const SurfaceSample& x : random_samples(mesh, 600, 4)) {
    bool covered = false;
    for (const SurfaceSample& y : disks.samples())
      covered |= (x.position - y.position).norm() <= 0.8 * sizing.at(y);
    CHECK(disks.is_free(x.position) == !covered);
    num_free += !covered;
    if (disks.samples().size() < 40) disks.add(x);
  }
  CHECK(num_free > 0);
  CHECK(num_free < 600);
}

namespace {

/// A method that gives round(factor / c^2) samples besides those that are fixed.
struct Ideal {
  const BaselineTask& task;
  double factor;
  std::vector<double> tried{};
  std::vector<SurfaceSample> operator()(double c) {
    tried.push_back(c);
    return std::vector<SurfaceSample>(
        task.fixed.size() + static_cast<std::size_t>(std::lround(factor / (c * c))),
        {Vec3(0.5, 0.5, 0), geom::FacetId(0)});
  }
};

}  // namespace

TEST_CASE("disks: the radius is found at once where the number goes with its inverse square") {
  const geom::TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 2);
  const Sizing sizing = Sizing::uniform(0.1);
  const std::vector<SurfaceSample> fixed(90, {Vec3(0, 0, 0), geom::FacetId(0)});
  for (const std::size_t n : {100, 1000, 5000}) {
    const BaselineTask task{mesh, sizing, fixed, n, 1, 1};
    Ideal ideal{task, 333};
    const BaselineResult result = search_radius(task, {}, std::ref(ideal));
    CHECK(result.run.reason == StopReason::target_reached);
    CHECK(result.samples.size() >= n - n / 1000);
    CHECK(result.samples.size() <= n + n / 1000);
    CHECK(result.radius_factor == ideal.tried.back());
    CHECK(ideal.tried.size() <= 4);
  }
}

TEST_CASE(
    "disks: of the radii tried the one with the nearest number is kept; interruption keeps the best whole "
    "one") {
  const geom::TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 2);
  const Sizing sizing = Sizing::uniform(0.1);
  const BaselineTask task{mesh, sizing, {}, 100, 1, 1};
  const std::vector<std::size_t> numbers{60, 150, 93, 115, 130, 99};
  std::atomic<bool> stop = false;
  for (const std::size_t last : {1, 2, 3, 6}) {
    for (const bool interrupt : {false, true}) {
      std::size_t tries = 0;
      stop = false;
      OptimizeOptions options;
      options.interrupted = &stop;
      options.max_iterations = static_cast<int>(last);
      const auto disks = [&](double) {
        stop = interrupt && tries + 1 == last;
        return std::vector<SurfaceSample>(numbers[tries++], {Vec3(0.5, 0.5, 0), geom::FacetId(0)});
      };
      if (interrupt && last == 1) {
        CHECK_THROWS_AS(search_radius(task, options, disks), geom::Interrupted);
        continue;
      }
      const BaselineResult result = search_radius(task, options, disks);
      CHECK(tries == last);
      const std::size_t counted = interrupt ? last - 1 : last;
      std::size_t best = numbers[0];
      for (std::size_t i = 0; i < counted; ++i)
        if (std::abs(double(numbers[i]) - 100) < std::abs(double(best) - 100)) best = numbers[i];
      CHECK(result.samples.size() == best);
      CHECK((result.run.reason == StopReason::interrupted) == interrupt);
    }
  }
}
