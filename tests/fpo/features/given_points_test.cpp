#include "fpo/features/given_points.h"

#include <limits>

#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::Vec3;

TEST_CASE("given points: they keep their bits and must lie on the surface") {
  const geom::TriMesh cube = geom::make_shape("cube");
  const std::vector<Vec3> points{Vec3(0.3, 0, 0), Vec3(0.25, 0.6, 1)};
  const std::vector<SurfaceSample> samples = points_on_surface(cube, points);
  REQUIRE(samples.size() == 2);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(samples[i].position == points[i]);
    const Vec3 normal = cube.normal(samples[i].facet);
    CHECK(std::abs(normal.dot(points[i] - cube.corner(samples[i].facet, 0))) < 1e-12);
  }
  CHECK(points_on_surface(cube, {}).empty());
  CHECK_THROWS_WITH_AS(points_on_surface(cube, std::vector<Vec3>{points[0], Vec3(0.5, 0.5, 0.5)}),
                       "point 2 does not lie on the surface", geom::InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(points_on_surface(cube, std::vector<Vec3>{Vec3(0, nan, 0)}), "point 1 is not finite",
                       geom::InputError);
}
