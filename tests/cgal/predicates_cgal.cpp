// The predicates against CGAL's in exact arithmetic.

#include "doctest.h"
#include "geom/exact/predicates.h"
#include "tests/cgal/exact_points.h"
#include "tests/fixtures/weighted_points.h"

namespace {

using cgal::Kernel;
using geom::WeightedPoint2;
using geom::WeightedPoint3;

constexpr int draws = 20000;  // of each hardship

Kernel::Weighted_point_3 exact(const WeightedPoint3& p) {
  return {Kernel::Point_3(p.position.x(), p.position.y(), p.position.z()), p.weight};
}
Kernel::Weighted_point_2 exact(const WeightedPoint2& p) {
  return {Kernel::Point_2(p.position.x(), p.position.y()), p.weight};
}

}  // namespace

TEST_CASE("CGAL: orientation and power side in the plane") {
  geom::Rng rng(1);
  const Kernel::Power_side_of_oriented_power_circle_2 power_side;
  for (const fixtures::Hardship hardship : fixtures::all_hardships) {
    INFO("hardship: " << fixtures::name_of(hardship));
    for (int i = 0; i < draws; ++i) {
      std::array<WeightedPoint2, 4> p;
      std::array<Kernel::Weighted_point_2, 4> x;
      const auto drawn = fixtures::draw(hardship, 4, true, rng);
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] = {drawn[k].position.head<2>(), drawn[k].weight};
        x[k] = exact(p[k]);
      }
      const int turn = geom::orient2(p[0].position, p[1].position, p[2].position);
      CHECK(turn == CGAL::orientation(x[0].point(), x[1].point(), x[2].point()));
      if (turn != 0) CHECK(geom::power_side2(p[0], p[1], p[2], p[3]) == -power_side(x[0], x[1], x[2], x[3]));
    }
  }
}

TEST_CASE("CGAL: orientation and power side in space") {
  geom::Rng rng(2);
  const Kernel::Power_side_of_oriented_power_sphere_3 power_side;
  for (const fixtures::Hardship hardship : fixtures::all_hardships) {
    INFO("hardship: " << fixtures::name_of(hardship));
    for (int i = 0; i < draws; ++i) {
      const auto p = fixtures::draw(hardship, 5, false, rng);
      std::array<Kernel::Weighted_point_3, 5> x;
      for (std::size_t k = 0; k < 5; ++k) x[k] = exact(p[k]);
      const int turn = geom::orient3(p[0].position, p[1].position, p[2].position, p[3].position);
      CHECK(turn == CGAL::orientation(x[0].point(), x[1].point(), x[2].point(), x[3].point()));
      if (turn != 0)
        CHECK(geom::power_side3(p[0], p[1], p[2], p[3], p[4]) == -power_side(x[0], x[1], x[2], x[3], x[4]));
    }
  }
}
