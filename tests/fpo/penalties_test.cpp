#include "fpo/penalties.h"

#include <map>

#include "doctest.h"
#include "geom/rng.h"

TEST_CASE("penalties: number and sum are those of a map under random change") {
  fpo::Penalties<geom::CircleId> penalties;
  std::map<std::size_t, double> expected;
  geom::Rng rng(5);
  for (int step = 0; step < 5000; ++step) {
    const std::size_t i = rng.below(200);
    const geom::CircleId x(i);
    CHECK(penalties.forget(x) == (expected.erase(i) > 0));
    CHECK(penalties.of(x) == 0);
    if (rng.below(2) == 0) {
      expected[i] = 1 + static_cast<double>(rng.below(64)) / 8;  // sums of these are exact
      penalties.add(x, expected[i]);
    }
  }
  double sum = 0;
  for (const auto& [i, penalty] : expected) {
    CHECK(penalties.of(geom::CircleId(i)) == penalty);
    sum += penalty;
  }
  CHECK(penalties.number() == expected.size());
  CHECK(penalties.sum() == sum);
  CHECK(!expected.empty());
}
