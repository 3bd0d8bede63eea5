#include "geom/sites/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"

using namespace geom;

namespace {

/// On a lattice, so that many are at one place and distances tie, or anywhere; on a sheet or in space.
std::vector<Vec3> placed_points(std::size_t n, bool lattice, double far, double size, Rng& rng) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    Vec3 p(rng.uniform(-1, 1), rng.uniform(-1, 1), 0.1 * rng.uniform(-1, 1));
    if (lattice) p = (4 * p).array().round();
    points.push_back(Vec3(far, -far, 0) + size * p);
  }
  return points;
}

template <class Check>
void for_all_kinds_of_points(const Check& check) {
  Rng rng(11);
  for (const std::size_t n : {0u, 1u, 2u, 8u, 9u, 17u, 500u})
    for (const bool lattice : {false, true})
      for (const double far : {0.0, 700.0})
        for (const double size : {1.0, 1e-9, 1e9}) {
          CAPTURE(n);
          CAPTURE(lattice);
          CAPTURE(far);
          CAPTURE(size);
          const std::vector<Vec3> points = placed_points(n, lattice, far * size, size, rng);
          check(points, size, rng);
        }
}

}  // namespace

TEST_CASE("point tree: finds all who may own a location of a vacancy, and few others") {
  for_all_kinds_of_points([](const std::vector<Vec3>& points, double size, Rng& rng) {
    const PointTree tree(points);
    for (int trial = 0; trial < 40; ++trial) {
      const Vec3 near = points.empty() ? Vec3(0, 0, 0) : points[rng.below(points.size())];
      const Vec3 center = near + size * 0.3 * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0);
      const double radius = size * rng.uniform(0, 0.3), power = trial % 4 == 0 ? -size : radius * radius;
      std::vector<SiteId> found;
      tree.heirs({SiteId(), center, radius, power}, found);
      std::ranges::sort(found);
      CHECK(std::ranges::adjacent_find(found) == found.end());
      const double distance = radius + std::sqrt(std::max(power, 0.0));
      const double rounding = 1e-5 * (points.empty() ? 0 : near.lpNorm<Eigen::Infinity>() + size);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = (points[i] - center).norm();
        const bool is_found = std::ranges::binary_search(found, SiteId(i));
        if (power >= 0 && d <= distance) CHECK(is_found);
        if (d > 1.001 * distance + rounding) CHECK(!is_found);
      }
    }
  });
}

TEST_CASE("point tree: the nearest, to the bit, as of all points and of the other tree") {
  for_all_kinds_of_points([](const std::vector<Vec3>& points, double size, Rng& rng) {
    const PointTree tree(points);
    SiteTree other;
    for (std::size_t i = 0; i < points.size(); ++i) other.insert(SiteId(i), {points[i], 0});
    for (int trial = 0; trial < 40; ++trial) {
      const std::size_t from = points.empty() ? 0 : rng.below(points.size());
      Vec3 x = points.empty() ? Vec3(1, 2, 3) : points[from];
      if (trial % 3 == 1) x += size * 0.5 * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 0);
      if (trial % 3 == 2) x = size * 40 * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), 1);
      const SiteId without = trial % 2 == 0 ? SiteId(from) : SiteId();
      const Location3 location(x, trial % 5 == 0 ? size : 0);
      SiteTree::Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
      for (std::size_t i = 0; i < points.size(); ++i)
        if (const double radius2 = power(location, WeightedPoint3{points[i], 0});
            SiteId(i) != without && radius2 < best.radius2)
          best = {SiteId(i), radius2};
      for (const NearSites* search :
           {static_cast<const NearSites*>(&tree), static_cast<const NearSites*>(&other)}) {
        const NearSites::Nearest found = search->nearest(location, without, SiteId());
        CHECK(found.site == best.site);
        CHECK(found.radius2 == best.radius2);
      }
    }
  });
}
