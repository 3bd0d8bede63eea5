// Their topology is tested with that of all shapes: shapes_test.cpp.
#include "geom/shapes/machined_shapes.h"

#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/shapes/layers.h"
#include "tests/fixtures/volume.h"

using fixtures::volume;
using geom::TriMesh;
using geom::Vec2;

TEST_CASE("machined shapes: volumes are those of the bodies") {
  const double pi = std::numbers::pi;
  CHECK(volume(geom::wedge(3)) == doctest::Approx(0.25 * std::sin(pi / 12)));
  CHECK(volume(geom::star(2)) == doctest::Approx(10 * 0.15 * std::sin(pi / 5) * 0.4));
  const double hole = 12 * 0.0625 * std::sin(pi / 12);
  CHECK(volume(geom::hole_plate(1)) == doctest::Approx((18 - 12 * hole) * 0.4));
  CHECK(volume(geom::rib(1)) == doctest::Approx(0.15 + 0.85 * 0.15 + 0.55 * 0.55 / 2 * 0.06));
  CHECK(volume(geom::cone_plate(300)) == doctest::Approx(pi * (0.15 + 0.25 / 3)).epsilon(1e-3));
  // A cylinder, and of the small one what is outside: its column less the column within the large one.
  double within = 0;
  for (int i = 0; i < 1000; ++i) {
    const double y = 0.6 * ((i + 0.5) / 500 - 1);
    within += 2 * std::sqrt(0.36 - y * y) * std::sqrt(1 - y * y) * 1.2 / 1000;
  }
  CHECK(volume(geom::two_cylinders(12)) == doctest::Approx(4 * pi + 0.36 * pi * 2 - within).epsilon(2e-3));
  const double core = pi * (0.4 * 9 + 0.8);
  CHECK(volume(geom::screw(64)) > core);
  CHECK(volume(geom::screw(64)) < core * 1.3 * 1.3);
}

TEST_CASE("layers: walls stand where solid meets empty, slabs of unequal outlines are closed by lids") {
  geom::PlanarCells plan;
  plan.add_ring({Vec2(0, 0), Vec2(3, 0), Vec2(3, 3), Vec2(0, 3)},
                {Vec2(1, 1), Vec2(2, 1), Vec2(2, 2), Vec2(1, 2)});
  const std::size_t ring = plan.cells().size();
  plan.add_quad({1, 1}, {2, 1}, {2, 2}, {1, 2});
  const auto solid = [&](std::size_t cell, std::size_t slab) { return cell < ring || slab == 0; };
  const TriMesh cup = geom::layered_surface({plan, {0, 1, 2}, solid});
  CHECK(geom::topology(cup).manifold());
  CHECK(geom::topology(cup).boundary_edges == 0);
  CHECK(geom::topology(cup).misoriented_edges == 0);
  CHECK(geom::topology(cup).euler == 2);
  CHECK(volume(cup) == doctest::Approx(9 + 8));
  const TriMesh frame =
      geom::layered_surface({plan, {0, 2}, [&](std::size_t cell, std::size_t) { return cell < ring; }});
  CHECK(geom::topology(frame).euler == 0);
  CHECK(volume(frame) == doctest::Approx(16));
}
