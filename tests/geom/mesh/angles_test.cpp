#include "geom/mesh/angles.h"

#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

TEST_CASE("angles: between vectors as they are turned, near 0 and pi too, whatever their lengths") {
  Rng rng(1);
  for (int draw = 0; draw < 500; ++draw) {
    const Vec3 u = fixtures::random_vector(rng).normalized(), w = u.unitOrthogonal();
    const double near = std::pow(10, rng.uniform(-12, 0)), scale = std::pow(10, rng.uniform(-9, 9));
    for (const double angle : {near, std::numbers::pi - near, rng.uniform(0, std::numbers::pi)}) {
      const Vec3 v = scale * (std::cos(angle) * u + std::sin(angle) * w);
      CHECK(std::abs(angle_between(u, v) - angle) < 4e-15);
      CHECK(angle_between(u, v) == angle_between(v, u));
    }
  }
  CHECK(angle_between(Vec3(0, 0, 0), Vec3(1, 2, 3)) == 0);
}

TEST_CASE("angles: those of a triangle sum to a half turn") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (FacetId t(0); t.index() < surface.mesh.num_facets(); t = FacetId(t.value + 1)) {
      const double sum = corner_angle(surface.mesh, t, 0) + corner_angle(surface.mesh, t, 1) +
                         corner_angle(surface.mesh, t, 2);
      CHECK(sum == doctest::Approx(std::numbers::pi).epsilon(1e-12));
    }
}
