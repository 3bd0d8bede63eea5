// How many sheets lie near one another.

#include "fpo/remesh/layers.h"

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using geom::TriMesh;
using geom::Vec3;

TEST_CASE("layers: a smooth surface is one, parallel copies of it are as many as there are") {
  const TriMesh square = fixtures::tilted_square(4);
  const double distance = 0.05 * square.diagonal();
  CHECK(fpo::layers_within(square, distance) == doctest::Approx(1).epsilon(0.25));
  TriMesh stack = square;
  const Vec3 up = 1e-3 * distance * square.normal(geom::FacetId(0)).normalized();
  for (int k = 2; k <= 8; ++k) {
    stack = geom::joined(
        stack, geom::mapped(square, [&](const Vec3& p) { return Vec3(p + static_cast<double>(k) * up); }));
    CHECK(fpo::layers_within(stack, distance) == doctest::Approx(k).epsilon(0.25));
  }
  CHECK(fpo::layers_within(stack, distance) == fpo::layers_within(stack, distance));
  CHECK(fpo::layers_within(geom::make_shape("sphere"), 0) == 0);
}
