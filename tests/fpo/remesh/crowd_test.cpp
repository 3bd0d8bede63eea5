// Input of which no remesh can be made.

#include "fpo/remesh/crowd.h"

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/needles.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"

using geom::TriMesh;
using geom::Vec3;

TEST_CASE("crowd: single facets, more pieces than samples and heaps of sheets are refused") {
  const TriMesh sphere = geom::make_shape("sphere", 4);
  geom::Rng rng(1);
  const TriMesh soup = fixtures::split_vertices(sphere, 1e-3, rng);
  CHECK_THROWS_AS(fpo::refuse_crowd(soup, 5 * soup.num_facets()), geom::InputError);
  CHECK_NOTHROW(fpo::refuse_crowd(soup, 100 * soup.num_facets()));

  TriMesh dust = sphere;
  for (int i = 1; i <= 20; ++i)
    dust = geom::joined(dust, geom::mapped(sphere, [&](const Vec3& p) {
                          return Vec3(1e-3 * p + 3 * sphere.diagonal() * i * Vec3(1, 0, 0));
                        }));
  CHECK_THROWS_AS(fpo::refuse_crowd(dust, 20), geom::InputError);
  CHECK_NOTHROW(fpo::refuse_crowd(dust, 21));

  TriMesh stack = fixtures::tilted_square(4);
  const TriMesh square = stack;
  const Vec3 up = 1e-3 * square.diagonal() * square.normal(geom::FacetId(0)).normalized();
  for (int k = 1; k < 24; ++k)
    stack = geom::joined(
        stack, geom::mapped(square, [&](const Vec3& p) { return Vec3(p + static_cast<double>(k) * up); }));
  CHECK_THROWS_AS(fpo::refuse_crowd(stack, 500), geom::InputError);
}

TEST_CASE("crowd: whatever is a surface is not refused") {
  for (const auto& surface : fixtures::surfaces())
    for (const std::size_t n : {10u, 300u, 5000u}) {
      CAPTURE(surface.name);
      CHECK_NOTHROW(fpo::refuse_crowd(surface.mesh, n));
    }
}

TEST_CASE(
    "crowd: threads are refused, plates, strips as wide as the spacing and tubes three samples around not") {
  const auto stretched = [](const TriMesh& mesh, double x, double y, double z) {
    return geom::mapped(mesh, [&](const Vec3& p) -> Vec3 { return {x * p.x(), y * p.y(), z * p.z()}; });
  };
  const TriMesh sphere = fixtures::stretched_sphere(40, 20, 1), cube = geom::make_shape("cube", 4);
  CHECK_THROWS_AS(fpo::refuse_thread(stretched(sphere, 1, 1, 1000), 300), geom::InputError);
  CHECK_THROWS_AS(fpo::refuse_thread(stretched(cube, 1, 1e-9, 1e-9), 300), geom::InputError);
  const TriMesh strip = geom::make_shape("square", 4);
  CHECK_THROWS_AS(fpo::refuse_thread(stretched(strip, 1e6, 1, 1), 300), geom::InputError);
  CHECK_NOTHROW(fpo::refuse_thread(stretched(strip, 300, 1, 1), 300));
  CHECK_NOTHROW(fpo::refuse_thread(stretched(sphere, 1, 1, 50), 300));
  CHECK_NOTHROW(fpo::refuse_thread(stretched(cube, 1, 1, 1e-9), 300));
  for (const auto& surface : fixtures::surfaces())
    for (const std::size_t n : {16u, 300u, 5000u}) {
      CAPTURE(surface.name);
      CHECK_NOTHROW(fpo::refuse_thread(surface.mesh, n));
    }
}
