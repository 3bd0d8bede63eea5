#include "geom/dual/empty_circles.h"

#include <algorithm>
#include <map>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"

using namespace geom;

namespace {

/// With one to three sites, ascending.
EmptyCircle draw_circle(Rng& rng, std::size_t num_sites) {
  EmptyCircle circle;
  circle.radius2 = rng.uniform();
  circle.center = Vec3::Constant(-circle.radius2);
  circle.facet = FacetId(static_cast<std::size_t>(rng.below(100)));
  std::vector<std::size_t> sites;
  for (const std::size_t wanted = 1 + rng.below(3); sites.size() < wanted;) {
    const std::size_t s = rng.below(num_sites);
    if (std::ranges::find(sites, s) == sites.end()) sites.push_back(s);
  }
  std::ranges::sort(sites);
  for (std::size_t k = 0; k < sites.size(); ++k) circle.sites[k] = SiteId(sites[k]);
  return circle;
}

EmptyCircle triangle(int a, int b, int c, bool clockwise = false) {
  EmptyCircle circle;
  circle.facet = FacetId(0);
  circle.sites = {SiteId(a), SiteId(b), SiteId(c)};
  circle.clockwise = clockwise;
  return circle;
}

}  // namespace

TEST_CASE("empty circles: against a map while circles come, move and go") {
  constexpr std::size_t num_sites = 30;
  Rng rng(8);
  EmptyCircles circles;
  std::map<CircleId, EmptyCircle> expected;
  std::vector<CircleId> erased;
  std::size_t most = 0;
  for (int step = 0; step < 20000; ++step) {
    const auto any = [&] {
      return std::next(expected.begin(), static_cast<int>(rng.below(expected.size())));
    };
    const auto kind = rng.below(20);
    if (kind == 0) {
      circles.recycle(erased);
      erased.clear();
    } else if (kind < 11 || expected.empty()) {
      const EmptyCircle circle = draw_circle(rng, num_sites);
      const CircleId c = circles.create(circle);
      CHECK(std::ranges::find(erased, c) == erased.end());  // not used again before it is recycled
      CHECK(expected.emplace(c, circle).second);
    } else if (kind < 12) {
      const auto at = any();
      at->second.radius2 = rng.uniform();
      at->second.center = Vec3::Constant(at->second.radius2);
      at->second.facet = FacetId(static_cast<std::size_t>(rng.below(100)));
      circles.move(at->first, at->second.center, at->second.radius2, at->second.facet);
    } else {
      const auto at = any();
      circles.erase(at->first);
      CHECK(circles[at->first].radius2 == at->second.radius2);  // still there to be read
      erased.push_back(at->first);
      expected.erase(at);
    }
    most = std::max(most, expected.size() + erased.size());
    CHECK(circles.size() == expected.size());
    const SiteId s(static_cast<std::size_t>(rng.below(num_sites + 2)));  // some have none
    const std::span<const CircleId> of_site = circles.of_site(s);
    std::vector<CircleId> listed(of_site.begin(), of_site.end()), touching;
    for (const auto& [c, circle] : expected)
      if (circle.touches(s)) touching.push_back(c);
    std::ranges::sort(listed);
    CHECK(listed == touching);
    if (step % 1000 == 0) circles.check();
  }
  CHECK(circles.num_ids() <= most + 1);
  for (const auto& [c, circle] : expected) {
    CHECK(circles[c].radius2 == circle.radius2);
    CHECK(circles[c].center == circle.center);
    CHECK(circles[c].facet == circle.facet);
    CHECK(circles[c].sites == circle.sites);
  }
}

TEST_CASE("empty circles: places around a circle, whichever way its sites run") {
  for (const bool clockwise : {false, true}) {
    const EmptyCircle circle = triangle(3, 5, 8, clockwise);
    CHECK(circle.is_triangle());
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(circle.index_of(circle.sites[i]) == i);
      CHECK(circle.before(circle.after(i)) == i);
      CHECK(circle.after(circle.after(circle.after(i))) == i);
      CHECK(circle.opposite(circle.sites[circle.after(i)], circle.sites[circle.before(i)]) == i);
      CHECK(circle.opposite(circle.sites[circle.before(i)], circle.sites[circle.after(i)]) == i);
    }
    CHECK(circle.sites[circle.after(0)] == SiteId(clockwise ? 8 : 5));
    CHECK(!circle.touches(SiteId(4)));
  }
}

TEST_CASE("empty circles: the order is by facet, place and sites, not by what follows from them") {
  EmptyCircle a = triangle(1, 2, 3), b = a;
  b.radius2 = 7;
  b.clockwise = true;
  CHECK(!circle_before(a, b));
  CHECK(!circle_before(b, a));
  b.sites[2] = SiteId(4);
  CHECK(circle_before(a, b));
  a.place = 1;
  CHECK(circle_before(b, a));
  b.facet = FacetId(1);
  CHECK(circle_before(a, b));
}

TEST_CASE("empty circles: a circle beyond that does not agree is found") {
  EmptyCircles circles;
  const CircleId c = circles.create(triangle(0, 1, 2)), d = circles.create(triangle(1, 2, 3)),
                 far = circles.create(triangle(4, 5, 6));
  CHECK_NOTHROW(circles.check());
  circles.set_beyond(c, 0, d);
  CHECK_THROWS_AS(circles.check(), Bug);  // d does not know it
  circles.set_beyond(d, 2, c);
  CHECK_NOTHROW(circles.check());
  circles.set_beyond(c, 1, d);
  CHECK_THROWS_AS(circles.check(), Bug);  // they share no such edge
  circles.set_beyond(c, 1, far);
  CHECK_THROWS_AS(circles.check(), Bug);
  circles.set_beyond(c, 1, CircleId());
  circles.erase(d);
  CHECK_THROWS_AS(circles.check(), Bug);  // an erased one is beyond
}
