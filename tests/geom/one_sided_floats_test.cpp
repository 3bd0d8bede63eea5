#include "geom/one_sided_floats.h"

#include <cmath>
#include <limits>

#include "doctest.h"
#include "geom/rng.h"

using namespace geom;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Is there no float between them and x, and is that one if it is a float?
bool are_next_to(double x) {
  const float up = rounded_up(x), down = rounded_down(x);
  if (static_cast<double>(static_cast<float>(x)) == x) return up == x && down == x;
  return down < x && x < up && (std::nextafter(down, infinite) == up);
}

}  // namespace

TEST_CASE("one-sided floats: the next floats on both sides, of numbers of any size") {
  Rng rng(5);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(400)) - 200);
    CAPTURE(x);
    REQUIRE(are_next_to(x));
    REQUIRE(are_next_to(static_cast<double>(static_cast<float>(x))));
  }
  for (const double x : {0.0, -0.0, 1e-300, -1e-300, 0x1p-149, 0x1.8p-149, -0x1.8p-149, 1e300, -1e300})
    CHECK(are_next_to(x));
  constexpr double beyond = std::numeric_limits<double>::infinity();
  CHECK(rounded_up(beyond) == infinite);
  CHECK(rounded_down(beyond) == infinite);
  CHECK(rounded_up(-beyond) == -infinite);
}
