#include "fpo/features/even_places.h"

#include "doctest.h"

using namespace fpo;

TEST_CASE("even places: ascending, in the range, all gaps the same, ends included where there are some") {
  for (const double length : {1.0, 7.3, 1e-5})
    for (const bool loop : {false, true})
      for (const std::size_t count : {0u, 1u, 2u, 3u, 17u}) {
        CAPTURE(length);
        CAPTURE(loop);
        CAPTURE(count);
        const std::vector<double> t = even_places(length, loop, count, 5);
        REQUIRE(t.size() == count);
        if (count == 0) continue;
        const double gap = length / static_cast<double>(count + (loop ? 0 : 1));
        CHECK(t.front() >= 0);
        CHECK(t.back() < length);
        if (!loop) CHECK(t.front() == doctest::Approx(gap));
        for (std::size_t i = 1; i < count; ++i) CHECK(t[i] - t[i - 1] == doctest::Approx(gap));
      }
}
