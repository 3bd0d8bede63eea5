#include "fpo/spectrum/spectrum_point.h"

#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/rng.h"

using fpo::SpectrumPoint;
using fpo::TangentFrame;
using geom::Vec3;

namespace {

Vec3 random_direction(geom::Rng& rng) {
  while (true) {
    const Vec3 x(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    if (x.norm() > 0.1 && x.norm() < 1) return x.normalized();
  }
}

}  // namespace

TEST_CASE("surface_length: great circles on spheres, seen from outside or inside; the same both ways") {
  geom::Rng rng(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double radius = rng.uniform(0.1, 10), side = trial % 2 ? 1 : -1;
    const Vec3 u = random_direction(rng), center = 3 * random_direction(rng);
    // Near ones, too, where the formula is a quotient of small differences.
    const Vec3 v = (u + std::pow(10, rng.uniform(-7, 0.5)) * random_direction(rng)).normalized();
    if (u.dot(v) < -0.99) continue;
    const SpectrumPoint a{.position = center + radius * u, .normal = side * u};
    const SpectrumPoint b{.position = center + radius * v, .normal = side * v};
    const double arc = radius * 2 * std::asin((u - v).norm() / 2);
    REQUIRE(fpo::surface_length(a, b) == doctest::Approx(arc).epsilon(1e-5));
    REQUIRE(fpo::surface_length(a, b) == doctest::Approx(fpo::surface_length(b, a)).epsilon(1e-12));
    REQUIRE(fpo::surface_length(a, b) >= (a.position - b.position).norm() * (1 - 1e-12));
  }
}

TEST_CASE("differential: in the plane the difference, in units of the mean spacing") {
  geom::Rng rng(2);
  for (int trial = 0; trial < 200; ++trial) {
    const SpectrumPoint a{.position = {rng.uniform(), rng.uniform(), 0}, .spacing = rng.uniform(0.1, 1)};
    const SpectrumPoint b{.position = {rng.uniform(), rng.uniform(), 0}, .spacing = rng.uniform(0.1, 1)};
    const auto there = fpo::differential(a, TangentFrame(a.normal), b);
    const auto back = fpo::differential(b, TangentFrame(b.normal), a);
    REQUIRE((there && back));
    const geom::Vec2 expected = (b.position - a.position).head<2>() * 2 / (a.spacing + b.spacing);
    CHECK((*there - expected).norm() < 1e-12 * expected.norm());
    CHECK((*there + *back).norm() < 1e-12 * expected.norm());
  }
}

TEST_CASE("differential: tangent frames are right-handed; turning everything about a normal turns it") {
  geom::Rng rng(3);
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 n = trial == 0 ? Vec3(1, 0, 0) : random_direction(rng);
    const TangentFrame frame(n);
    CHECK(std::abs(frame.first.norm() - 1) < 1e-12);
    CHECK((frame.first.cross(frame.second) - n).norm() < 1e-12);
    const SpectrumPoint a{.position = Vec3(1, 2, 3), .normal = n};
    const Vec3 m = random_direction(rng);
    const SpectrumPoint b{.position = a.position + random_direction(rng), .normal = m};
    const auto d = fpo::differential(a, frame, b);
    CHECK(d.has_value() == (n.dot(m) >= 0));
    if (!d) continue;
    CHECK(d->norm() == doctest::Approx(fpo::surface_length(a, b)));
    const Eigen::AngleAxisd turn(1.0, n);
    const auto turned =
        fpo::differential(a, frame, {a.position + turn * (b.position - a.position), turn * m, 1});
    REQUIRE(turned);
    CHECK((*turned - Eigen::Rotation2Dd(1.0) * *d).norm() < 1e-6 * d->norm());
  }
}

TEST_CASE("differential: none straight above and between sheets that face away; zero for equal places") {
  const SpectrumPoint a;
  const TangentFrame frame(a.normal);
  CHECK(!fpo::differential(a, frame, {Vec3(0, 0, 1), Vec3(0, 0, 1), 1}));
  CHECK(!fpo::differential(a, frame, {Vec3(1, 0, 0), Vec3(0, 0, -1), 1}));
  const auto zero = fpo::differential(a, frame, a);
  REQUIRE(zero);
  CHECK(*zero == geom::Vec2(0, 0));
}
