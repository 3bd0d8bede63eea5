#include "geom/dual/reaches.h"

#include <algorithm>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

TEST_CASE("reaches: set, raised and forgotten; none is larger than the largest, which sinks with them") {
  Clipper::Sites sites;
  const EmptyCircles circles;
  SiteSearch search(sites, circles);
  Reaches reach(search);
  constexpr std::size_t n = 30;
  Rng rng(1);
  for (std::size_t i = 0; i < n; ++i) {
    sites.push_back({fixtures::random_vector(rng), 0});
    search.enter(SiteId(i));
  }
  reach.resize(n);
  std::vector<double> expected(n, Reaches::of_nothing);
  for (int step = 0; step < 2000; ++step) {
    const std::size_t i = rng.below(n);
    const double bound = rng.uniform(0, step < 1000 ? 9 : 2);
    const auto kind = rng.below(8);
    if (kind == 0) reach.forget(SiteId(i)), expected[i] = Reaches::of_nothing;
    if (kind == 1) reach.set(SiteId(i), bound), expected[i] = bound;
    if (kind > 1) reach.raise(SiteId(i), bound), expected[i] = std::max(expected[i], bound);
    CHECK(reach[SiteId(i)] == expected[i]);
    CHECK(reach.largest() >= std::ranges::max(expected));
  }
  for (std::size_t i = 0; i < n; ++i) reach.set(SiteId(i), 1);
  for (std::size_t i = 0; i < n; ++i) reach.largest();
  CHECK(reach.largest() == 1);
}
