#include "fpo/surface/progressive.h"

#include <algorithm>
#include <limits>

#include "doctest.h"
#include "geom/rng.h"

using geom::Vec3;

namespace {

struct Cloud {
  std::vector<Vec3> points;
  std::vector<double> wanted;
};

Cloud random_cloud(std::size_t n, std::uint64_t seed, bool graded) {
  geom::Rng rng(seed);
  Cloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(rng.uniform(), rng.uniform(), rng.uniform());
    cloud.wanted.push_back(graded ? 0.1 + cloud.points.back().x() : 1);
  }
  return cloud;
}

}  // namespace

TEST_CASE("each point in turn is the one that is farthest from those before it, by brute force") {
  for (const bool graded : {false, true})
    for (const std::size_t n : {1u, 2u, 9u, 100u, 400u}) {
      CAPTURE(n);
      const Cloud cloud = random_cloud(n, n, graded);
      const std::vector<std::size_t> ranks = fpo::progressive_ranks(cloud.points, cloud.wanted);
      std::vector<std::size_t> order(n, n);
      for (std::size_t i = 0; i < n; ++i) order[ranks[i]] = i;
      CHECK(order[0] == 0);
      std::vector<double> distance(n, std::numeric_limits<double>::infinity());
      for (std::size_t rank = 0; rank < n; ++rank) {
        const std::size_t x = order[rank];
        REQUIRE(x < n);  // a permutation
        for (std::size_t later = rank + 1; rank > 0 && later < n; ++later)
          CHECK(distance[x] / cloud.wanted[x] >= distance[order[later]] / cloud.wanted[order[later]]);
        for (std::size_t i = 0; i < n; ++i)
          distance[i] = std::min(distance[i], (cloud.points[i] - cloud.points[x]).norm());
      }
    }
}

TEST_CASE("points at one place have ranks, too, the first first") {
  const std::vector<Vec3> points(30, Vec3(1, 2, 3));
  const std::vector<double> wanted(30, 1.0);
  const std::vector<std::size_t> ranks = fpo::progressive_ranks(points, wanted);
  for (std::size_t i = 0; i < ranks.size(); ++i) CHECK(ranks[i] == i);
}
