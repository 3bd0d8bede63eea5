#include "fpo/spectrum/spacing_tree.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using fpo::SpacingTree;
using fpo::SpectrumPoint;
using geom::Vec3;

namespace {

SpectrumPoint random_point(geom::Rng& rng) {
  SpectrumPoint p{.position = {rng.uniform(), rng.uniform(), rng.uniform()},
                  .spacing = rng.uniform(0.01, 0.2)};
  p.normal = Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0.3).normalized();
  return p;
}

}  // namespace

TEST_CASE("SpacingTree: both queries against all points, equal ones among them") {
  geom::Rng rng(4);
  for (const std::size_t n : {1u, 2u, 17u, 400u}) {
    std::vector<SpectrumPoint> points;
    for (std::size_t i = 0; i < n; ++i) points.push_back(random_point(rng));
    for (std::size_t i = 1; i < n; i += 5) points[i] = points[i - 1];
    const SpacingTree tree(points);
    REQUIRE(tree.points().size() == n);
    for (int query = 0; query < 60; ++query) {
      const SpectrumPoint x = query % 3 == 0 ? points[rng.below(n)] : random_point(rng);
      const double radius = rng.uniform(0, 5);
      std::vector<std::uint32_t> found, expected;
      tree.each_near(x, radius, [&](std::uint32_t k) { found.push_back(tree.order()[k]); });
      std::vector<SpacingTree::Neighbour> order;
      for (std::uint32_t i = 0; i < n; ++i) {
        const double d2 = (points[i].position - x.position).squaredNorm();
        const double limit = radius * (x.spacing + points[i].spacing) / 2;
        if (d2 < limit * limit) expected.push_back(i);
        if (points[i].normal.dot(x.normal) >= 0) order.push_back({d2, i});
      }
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
      const std::size_t count = rng.below(12);
      std::sort(order.begin(), order.end());
      order.resize(std::min(order.size(), count));
      std::vector<SpacingTree::Neighbour> nearest;
      tree.nearest(x, count, nearest);
      CHECK((nearest == order));
    }
  }
  CHECK_THROWS_AS(SpacingTree({}), geom::InputError);
}
