#include "geom/sites/nearest_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "doctest.h"
#include "geom/rng.h"

using geom::Vec3;

TEST_CASE("nearest distances: those of all pairs, from any point on, on any number of threads") {
  geom::Rng rng(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 1500; ++i)  // on a lattice: some are twice
    points.push_back({double(rng.below(16)), double(rng.below(16)), double(rng.below(16))});
  for (const std::size_t first : {std::size_t{0}, std::size_t{7}, points.size()}) {
    const std::vector<double> found = geom::nearest_distances(points, first);
    REQUIRE(found.size() == points.size() - first);
    for (std::size_t i = 0; i < found.size(); i += 11) {
      double least2 = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < points.size(); ++j)
        if (j != first + i) least2 = std::min(least2, (points[j] - points[first + i]).squaredNorm());
      CHECK(found[i] == std::sqrt(least2));
    }
    CHECK(geom::nearest_distances(points, first, 3) == found);
  }
  CHECK(geom::nearest_distances(std::vector{Vec3(1, 2, 3)}).front() ==
        std::numeric_limits<double>::infinity());
}
