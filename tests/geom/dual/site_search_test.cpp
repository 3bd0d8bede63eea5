#include "geom/dual/site_search.h"

#include <algorithm>
#include <vector>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

namespace {

/// Sites in the unit cube that come, go and move, each within the bound of their coordinates.
struct Crowd {
  explicit Crowd(std::size_t n) : search(sites, circles), is_in(n, true) {
    for (std::size_t i = 0; i < n; ++i) {
      sites.push_back({anywhere(), 0});
      search.allow(0);
      search.enter(SiteId(i));
    }
  }
  Vec3 anywhere() { return Vec3(rng.uniform(), rng.uniform(), rng.uniform()); }
  void step() {
    const std::size_t i = rng.below(is_in.size());
    const SiteId p(i);
    const Vec3 from = sites[p].position;
    if (!is_in[i]) {
      sites[p].position = anywhere();
      search.enter(p);
    } else if (rng.below(2) == 0) {
      search.leave(p);
    } else {
      sites[p].position = anywhere();
      search.follow(p, from);
      return;
    }
    is_in[i] = !is_in[i];
  }
  Rng rng{4};
  Clipper::Sites sites;
  EmptyCircles circles;
  SiteSearch search;
  std::vector<bool> is_in;
};

}  // namespace

TEST_CASE("site search: the nearest and all who are near, by brute force, in a grid and in a tree") {
  for (const bool in_grid : {true, false}) {
    CAPTURE(in_grid);
    Crowd crowd(200);
    const double area = in_grid ? 6 : 1e-30;  // of so little area coordinates are too large for a grid
    CHECK((crowd.search.choose(area, 1) > 0) == in_grid);
    for (int draw = 0; draw < 300; ++draw) {
      crowd.step();
      CHECK(crowd.search.size() == static_cast<std::size_t>(std::ranges::count(crowd.is_in, true)));
      const Vec3 x = crowd.anywhere();
      const double radius = crowd.rng.uniform(0, 0.2), power = crowd.rng.uniform(0, 0.02);
      std::vector<SiteId> near;
      crowd.search.near({SiteId(), x, radius, power}, near);
      std::vector<SiteId> around;
      const bool is_quick = crowd.search.find_near(x, radius, around);
      CHECK((in_grid || !is_quick));
      SiteId nearest;
      for (std::size_t i = 0; i < crowd.is_in.size(); ++i) {
        if (!crowd.is_in[i]) continue;
        const double distance = (crowd.sites[SiteId(i)].position - x).norm();
        if (!nearest.valid() || distance < (crowd.sites[nearest].position - x).norm()) nearest = SiteId(i);
        // It owns a location z of the vacancy only if |z - site|^2 <= power, and |z - x| <= radius.
        if (distance <= radius + std::sqrt(power)) CHECK(std::ranges::find(near, SiteId(i)) != near.end());
        if (is_quick && distance <= radius) CHECK(std::ranges::find(around, SiteId(i)) != around.end());
      }
      CHECK(crowd.search.nearest({x, 0}, SiteId()).site == nearest);
    }
  }
}
