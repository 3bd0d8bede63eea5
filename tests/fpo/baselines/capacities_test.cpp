#include "fpo/baselines/capacities.h"

#include "doctest.h"
#include "fpo/baselines/cell_moments.h"
#include "fpo/surface/initial_samples.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

TEST_CASE("capacities: masses and first moments are those of cell_moments.h; threads do not matter") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const Sizing even = fixtures::even(mesh, 60),
                 varying = fixtures::graded(mesh, 0.1 / mesh.diagonal(), 0.2 / mesh.diagonal());
    for (const Sizing* sizing : {&even, &varying}) {
      const auto samples = random_samples(mesh, *sizing, 60, 5);
      Capacities capacities(mesh, *sizing, 0.2, 2), by_one(mesh, *sizing, 0.2, 1);
      VoronoiMoments moments(mesh, *sizing, 0.2, 1);
      const auto found = capacities.of(samples), same = by_one.of(samples);
      const auto& expected = moments.of(samples);
      REQUIRE(found.walls.size() == same.walls.size());
      for (std::size_t k = 0; k < found.walls.size(); ++k) CHECK(found.walls[k].gain == same.walls[k].gain);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const CellCapacity& cell = found.cells[SiteId(i)];
        CHECK(cell.capacity == same.cells[SiteId(i)].capacity);
        CHECK(cell.mass == doctest::Approx(expected[SiteId(i)].mass).epsilon(1e-9));
        CHECK(cell.second == doctest::Approx(expected[SiteId(i)].second).epsilon(1e-9));
        CHECK((cell.first - expected[SiteId(i)].first).norm() <= 1e-9);
      }
    }
  }
}

TEST_CASE("capacities: walls are the derivative of the capacities") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing even = fixtures::even(mesh, 150),
               varying = fixtures::graded(mesh, 0.1 / mesh.diagonal(), 0.2 / mesh.diagonal());
  for (const Sizing* sizing : {&even, &varying}) {
    Capacities capacities(mesh, *sizing, 0.2, 1);
    std::vector<SurfaceSample> samples = random_samples(mesh, *sizing, 150, 8);
    const Capacities::Diagram at = capacities.of(samples);
    double scale = 0, error = 0;
    for (const std::size_t i : {2, 30, 77}) {
      std::vector<Vec3> derivative(samples.size(), Vec3(0, 0, 0));  // of each capacity by position i
      for (const CellWall& wall : at.walls)
        if (wall.owner == SiteId(i)) {
          derivative[i] += wall.gain;
          derivative[wall.other.index()] -= wall.gain;
        }
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-5;
        const SurfaceSample kept = samples[i];
        samples[i].position[axis] += step;
        const auto after = capacities.of(samples);
        samples[i].position[axis] -= 2 * step;
        const auto before = capacities.of(samples);
        samples[i] = kept;
        for (std::size_t j = 0; j < samples.size(); ++j) {
          const double change = after.cells[SiteId(j)].capacity - before.cells[SiteId(j)].capacity;
          scale = std::max(scale, derivative[j].norm());
          error = std::max(error, std::abs(change / (2 * step) - derivative[j][axis]));
        }
      }
    }
    CHECK(scale > 0);
    CHECK(error < (sizing->is_uniform() ? 1e-4 : 0.05) * scale);  // quadrature depends on the fragments
  }
}
