#include "geom/mesh/distance_from_triangle.h"

#include <cmath>

#include "doctest.h"
#include "geom/rng.h"

using geom::Vec3;

TEST_CASE("distance from a triangle: that of the closest point, of all regions, of needles and of no area") {
  geom::Rng rng(3);
  const auto draw = [&] { return 2 * rng.uniform() - 1; };
  const auto point = [&] { return Vec3(draw(), draw(), draw()); };
  for (int i = 0; i < 2000; ++i) {
    std::array<Vec3, 3> q{point(), point(), point()};
    if (i % 4 == 1) q[2] = q[0] + draw() * (q[1] - q[0]) + 1e-6 * point();
    if (i % 4 == 2) q[2] = i % 8 == 2 ? q[1] : Vec3((q[0] + q[1]) / 2);
    if (i % 4 == 3) q[1].z() = q[2].z() = q[0].z() = 0;
    CAPTURE(i);
    const geom::DistanceFromTriangle triangle(q);
    for (int k = 0; k < 20; ++k) {
      Vec3 x = 2 * point();
      if (k % 5 == 1) x = q[static_cast<std::size_t>(k) % 3];
      if (k % 5 == 2) x = q[0] + 0.3 * (q[1] - q[0]) + 0.3 * (q[2] - q[0]);
      const double expected = geom::closest_point(x, q).distance2;
      CHECK(std::abs(triangle.distance2(x) - expected) <= 1e-9 * (expected + 1e-3));
      for (const double limit2 : {0.0, 1e-4, 0.01, 0.1, 0.99 * expected, 1.01 * expected + 1e-12, 4.0})
        if (std::abs(limit2 - expected) > 1e-9 * (expected + 1e-3))
          CHECK(triangle.is_within(x, limit2) == (expected <= limit2));
      const double s = rng.uniform(), r = rng.uniform();
      const Vec3 y = q[0] + s * (q[1] - q[0]) + (1 - s) * r * (q[2] - q[0]);
      for (const Vec3& corner : q) CHECK((y - corner).squaredNorm() <= triangle.diameter2());
    }
  }
}

TEST_CASE("distance from a triangle: needles of any width, seen from afar, are within what they are within") {
  geom::Rng rng(4);
  const auto point = [&] { return Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)); };
  for (int i = 0; i < 20000; ++i) {
    const double width = std::pow(10, rng.uniform(-7, 0));
    const Vec3 a = point(), b = point(), c = b + width * point();
    const geom::DistanceFromTriangle triangle({a, b, c});
    Vec3 x = point();
    if (i % 2 == 0) x = (c - b).cross((b - a).cross(c - a)).normalized();  // beside its short side
    x = (b + c) / 2 + std::pow(10, rng.uniform(-1, 2)) * x;
    const double distance2 = triangle.distance2(x);
    CAPTURE(i);
    CHECK(triangle.is_within(x, distance2 * (1 + 1e-6)));
    CHECK(!triangle.is_within(x, distance2 * (1 - 1e-6)));
  }
}
