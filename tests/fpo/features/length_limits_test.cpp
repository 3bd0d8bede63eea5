// The least length that narrow places allow, by a tree.

#include "fpo/features/length_limits.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "geom/rng.h"

namespace {

using fpo::LengthLimits;
using fpo::NarrowPlace;
using geom::Vec3;

Vec3 random_point(geom::Rng& rng, double size) {
  const double x = rng.uniform(-size, size), y = rng.uniform(-size, size), z = rng.uniform(-size, size);
  return Vec3(x, y, z);
}

/// Every place by itself.
LengthLimits::Limit by_definition(const std::vector<NarrowPlace>& places, double slope, double most,
                                  const Vec3& x) {
  LengthLimits::Limit limit;
  const double cell = most / slope;
  for (const NarrowPlace& place : places) {
    const Vec3 a = (place.at / cell).array().floor(), b = (x / cell).array().floor();
    if ((a - b).cwiseAbs().maxCoeff() > 1) continue;
    const double d = (place.at - x).norm();
    limit.length = std::min(limit.length, fpo::widths_of_length * place.width + slope * d);
    limit.distance = std::min(limit.distance, d);
  }
  return limit;
}

}  // namespace

TEST_CASE("length limits: those of all places around, to the bit") {
  geom::Rng rng(7);
  for (const std::size_t count : {0UL, 1UL, 7UL, 9UL, 500UL, 3000UL})
    for (const double most : {0.05, 0.4, 3.0}) {
      std::vector<NarrowPlace> places;
      for (std::size_t i = 0; i < count; ++i) {
        Vec3 at = random_point(rng, 1);
        if (i % 3 == 0) at = Vec3(at.x(), 0.25, 0.25);  // along a line
        if (i % 7 == 0 && i > 0) at = places.back().at;
        places.push_back({at, rng.uniform(0.001, 0.1), 0, 1, 0.1, true});
      }
      const LengthLimits limits(places, 0.3, most);
      for (int i = 0; i < 300; ++i) {
        const Vec3 x =
            i % 5 == 0 && count > 0 ? places[static_cast<std::size_t>(i) % count].at : random_point(rng, 2);
        const LengthLimits::Limit found = limits.at(x), wanted = by_definition(places, 0.3, most, x);
        CHECK(found.length == wanted.length);
        CHECK(found.distance == wanted.distance);
      }
    }
}
