#include "geom/parallel.h"

#include <numeric>
#include <stdexcept>

#include "doctest.h"

TEST_CASE("parallel_ranges: every index once, in the same ranges for any number of threads") {
  for (const std::size_t count : {0, 1, 7, 64, 1000})
    for (const std::size_t grain : {1, 7, 2000})
      for (const int threads : {0, 1, 2, 9}) {
        std::vector<int> visits(count, 0);
        geom::parallel_ranges(count, grain, threads, [&](std::size_t first, std::size_t last) {
          if (first % grain != 0 || (last % grain != 0 && last != count)) throw std::logic_error("range");
          for (std::size_t i = first; i < last; ++i) ++visits[i];
        });
        CHECK(visits == std::vector<int>(count, 1));
      }
}

TEST_CASE("parallel_ranges: an exception arrives where the loop was called") {
  for (const int threads : {1, 3})
    CHECK_THROWS_AS(geom::parallel_ranges(100, 1, threads,
                                          [](std::size_t first, std::size_t) {
                                            if (first == 42) throw std::runtime_error("42");
                                          }),
                    std::runtime_error);
}
