// Rims: of stars against the links of the sites, of conflicts against all circles of the diagram.

#include "geom/dual/rim.h"

#include <algorithm>
#include <set>

#include "doctest.h"
#include "tests/fixtures/dual_scene.h"

using namespace geom;
using fixtures::Placed;
using Scene = fixtures::DualScene;

namespace {

/// Each edge of the rim is that of the circles at its ends, one inside and one outside.
void check_edges(const Scene& scene, const Rim& rim) {
  const std::set<CircleId> inside(rim.inside().begin(), rim.inside().end());
  CHECK(inside.size() == rim.inside().size());
  for (int j = 0; j < rim.size(); ++j) {
    CHECK(inside.contains(rim.inner(j)));
    CHECK(!inside.contains(rim.outer(j)));
    for (const CircleId c : {rim.inner(j), rim.outer(j)}) {
      const EmptyCircle& circle = scene.state.circles[c];
      CHECK(std::ranges::count(circle.sites, rim[j]) == 1);
      CHECK(std::ranges::count(circle.sites, rim[rim.next(j)]) == 1);
    }
    CHECK(rim.previous(rim.next(j)) == j);
  }
}

std::set<CircleId> beaten_by(const Scene& scene, const WeightedPoint3& point) {
  std::set<CircleId> result;
  for (const SiteId s : scene.present)
    for (const CircleId c : scene.state.circles.of_site(s))
      if (scene.state.lead_at(scene.state.circles[c], point).negative()) result.insert(c);
  return result;
}

}  // namespace

TEST_CASE("the rim of a star is the link of its site, counterclockwise") {
  int opened = 0;
  fixtures::for_scenes(150, [&](const Scene& scene, std::span<const Placed>) {
    Rim rim;
    for (const SiteId p : scene.present) {
      if (!rim.open_star(scene.state, p)) continue;
      ++opened;
      std::vector<SiteId> sites(rim.sites().begin(), rim.sites().end());
      std::ranges::sort(sites);
      CHECK(sites == scene.link(p));
      CHECK(std::ranges::equal(
          std::set<CircleId>(rim.inside().begin(), rim.inside().end()),
          std::set<CircleId>(scene.state.circles.of_site(p).begin(), scene.state.circles.of_site(p).end())));
      check_edges(scene, rim);
      for (int j = 0; j < rim.size(); ++j) {  // p, j, j + 1 run as the circle's sites do
        const EmptyCircle& circle = scene.state.circles[rim.inner(j)];
        CHECK(circle.sites[circle.after(circle.index_of(p))] == rim[j]);
      }
    }
  });
  CHECK(opened > 500);
}

TEST_CASE("the rim of a conflict has inside what a point beats, if that hangs together") {
  int found = 0, all = 0;
  fixtures::for_scenes(150, [&](const Scene& scene, std::span<const Placed> others) {
    Rim rim;
    for (const Placed& other : others) {
      const std::set<CircleId> beaten = beaten_by(scene, other.point);
      if (beaten.empty() || !rim.find_conflict(scene.state, other.point, *beaten.begin())) continue;
      ++found;
      for (const CircleId c : rim.inside()) CHECK(beaten.contains(c));
      all += rim.inside().size() == beaten.size();
      CHECK(static_cast<std::size_t>(rim.size()) == rim.inside().size() + 2);
      check_edges(scene, rim);
    }
  });
  CHECK(found > 100);
  CHECK(2 * all > found);
}
