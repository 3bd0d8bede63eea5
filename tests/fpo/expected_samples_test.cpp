#include "fpo/expected_samples.h"

#include <map>
#include <vector>

#include "doctest.h"

using fpo::ExpectedSamples;
using geom::SiteId;

TEST_CASE("expected samples: each is loaded for four, three, two and one calls ahead, in this order") {
  ExpectedSamples expected;
  std::map<SiteId, std::vector<int>> loads;
  constexpr int n = 20;
  for (int i = 0; i < n; ++i)
    expected.announce(SiteId(i), [&](SiteId x, int calls) {
      CHECK(x.value + 4 - i == calls);  // x is moved with the call that announces x + 4
      loads[x].push_back(calls);
    });
  CHECK(loads.size() == n);
  for (int i = 0; i + 3 < n; ++i) CHECK(loads[SiteId(i)] == std::vector{4, 3, 2, 1});
}
