#include "geom/site_tree.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "doctest.h"
#include "geom/rng.h"

using namespace geom;

namespace {

struct Site {
  WeightedPoint3 point;
  double reach;
};

/// Points whose density and reach vary by a factor of 50 along x, some of them at one place.
Site random_site(Rng& rng) {
  const double t = rng.uniform(), size = 0.002 * std::pow(50, t);
  if (rng.below(10) == 0) return {{Vec3(0.5, 0.5, 0.5), 0}, 0.0001};
  return {{Vec3(t, rng.uniform() * 20 * size, rng.uniform() * 20 * size), size * size * rng.uniform()},
          size * size * (2 * rng.uniform() - 0.2)};
}

bool found(const std::vector<SiteId>& list, SiteId s) { return std::ranges::find(list, s) != list.end(); }

}  // namespace

TEST_CASE("site tree: rivals, heirs and nearest against brute force while sites come and go") {
  Rng rng(5);
  SiteTree tree;
  std::map<SiteId, Site> present;
  for (int step = 0; step < 3000; ++step) {
    const SiteId p(static_cast<std::size_t>(rng.below(600)));
    if (present.contains(p)) {
      tree.remove(p);
      present.erase(p);
    } else {
      present[p] = random_site(rng);
      tree.insert(p, present[p].point);
      tree.set_reach(p, present[p].reach);
    }
    if (step % 20 != 0 || present.size() < 2) continue;
    tree.check();
    const auto& [q, own] =
        *std::next(present.begin(), static_cast<std::ptrdiff_t>(rng.below(present.size())));

    // Whoever could lose a location to q within its reach must be named; far ones should not be.
    std::vector<SiteId> rivals;
    tree.rivals(q, rivals);
    CHECK(std::ranges::adjacent_find(rivals) == rivals.end());
    std::size_t expected = 0;
    for (const auto& [s, site] : present) {
      if (s == q || site.reach + own.point.weight < 0) continue;
      const double limit =
          std::sqrt(site.reach + own.point.weight) + std::sqrt(std::max(0.0, site.reach + site.point.weight));
      if ((site.point.position - own.point.position).norm() >= limit) continue;
      ++expected;
      CHECK(found(rivals, s));
    }
    CHECK(rivals.size() <= expected + 5);

    const Vacancy vacancy{SiteId(), own.point.position, 0.05 * rng.uniform(), 0.01 * rng.uniform()};
    std::vector<SiteId> heirs;
    tree.heirs(vacancy, heirs);
    for (const auto& [s, site] : present)
      if ((site.point.position - vacancy.center).norm() <
          vacancy.radius + std::sqrt(vacancy.max_radius2 + site.point.weight))
        CHECK(found(heirs, s));

    const Vec3 x(rng.uniform(), rng.uniform(), rng.uniform());
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [s, site] : present)
      if (s != q) best = std::min(best, power(x, site.point));
    CHECK(tree.nearest(x, q).radius2 == best);
  }
}
