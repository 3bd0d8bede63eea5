#include "geom/empty_circles.h"

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
  std::vector<std::size_t> sites;
  for (const std::size_t wanted = 1 + rng.below(3); sites.size() < wanted;) {
    const std::size_t s = rng.below(num_sites);
    if (std::ranges::find(sites, s) == sites.end()) sites.push_back(s);
  }
  std::ranges::sort(sites);
  for (std::size_t k = 0; k < sites.size(); ++k) circle.sites[k] = SiteId(sites[k]);
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
      circles.move(at->first, at->second.center, at->second.radius2);
    } else {
      const auto at = any();
      circles.erase(at->first);
      CHECK(circles[at->first].radius2 == at->second.radius2);  // still there to be read
      erased.push_back(at->first);
      expected.erase(at);
    }
    most = std::max(most, expected.size() + erased.size());
    CHECK(circles.num_ids() == expected.size() + erased.size() + circles.num_free());
    const SiteId s(static_cast<std::size_t>(rng.below(num_sites + 2)));  // some have none
    std::vector<CircleId> listed, touching;
    for (CircleId c = circles.first(s); c.valid(); c = circles.next(c, s)) listed.push_back(c);
    for (const auto& [c, circle] : expected)
      if (std::ranges::count(circle.sites, s) > 0) touching.push_back(c);
    std::ranges::sort(listed);
    CHECK(listed == touching);
    if (step % 1000 == 0) CHECK(circles.check() == expected.size());
  }
  CHECK(circles.num_ids() <= most);
  for (const auto& [c, circle] : expected) {
    CHECK(circles[c].radius2 == circle.radius2);
    CHECK(circles[c].center == circle.center);
    CHECK(circles[c].sites == circle.sites);
  }
}
