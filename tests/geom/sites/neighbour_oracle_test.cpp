#include "geom/sites/neighbour_oracle.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <set>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"
#include "geom/sites/triangulation_oracle.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

namespace {

using Nearest = NeighbourOracle::Nearest;

/// Both sources and a list, with the same sites in.
struct Sources {
  explicit Sources(const Box3& box) : triangulation(box) {}

  void insert(SiteId id, const WeightedPoint3& point) {
    const SiteId hint = present.empty() ? SiteId() : *present.begin();
    tree.insert(id, point, hint);
    triangulation.insert(id, point, hint);
    if (id.index() >= points.size()) points.resize(id.index() + 1);
    points[id] = point;
    present.insert(id);
  }
  void remove(SiteId id) {
    tree.remove(id);
    triangulation.remove(id);
    present.erase(id);
  }
  Nearest nearest(const Vec3& x, SiteId without) const {
    Nearest best{SiteId(), std::numeric_limits<double>::infinity()};
    for (const SiteId s : present) {
      if (s == without) continue;
      const double radius2 = power(x, points[s]);
      if (!best.site.valid() || radius2 < best.radius2) best = {s, radius2};
    }
    return best;
  }
  void check_nearest(const Vec3& x, SiteId without, SiteId hint) const {
    const Nearest best = nearest(x, without);
    for (const NeighbourOracle* source :
         {static_cast<const NeighbourOracle*>(&tree), static_cast<const NeighbourOracle*>(&triangulation)}) {
      const Nearest found = source->nearest(x, without, hint);
      CHECK(found.site == best.site);
      CHECK(found.radius2 == best.radius2);
    }
  }

  SiteTree tree;
  TriangulationOracle triangulation;
  Table<SiteId, WeightedPoint3> points;
  std::set<SiteId> present;
};

}  // namespace

TEST_CASE("neighbour sources: the nearest site is that of trying all, from any hint, hidden sites included") {
  Rng rng(13);
  std::size_t hidden = 0;
  for (const fixtures::Hardship hardship :
       {fixtures::Hardship::none, fixtures::Hardship::unweighted, fixtures::Hardship::grid,
        fixtures::Hardship::nudged_grid, fixtures::Hardship::plane, fixtures::Hardship::far_sphere,
        fixtures::Hardship::duplicates, fixtures::Hardship::orthogonal}) {
    CAPTURE(fixtures::name_of(hardship));
    const std::vector<WeightedPoint3> pool = fixtures::draw(hardship, 120, false, rng);
    Box3 box;
    for (const WeightedPoint3& p : pool) box.extend(p.position);
    Sources sources(box);
    const auto any_present = [&] {
      return *std::next(sources.present.begin(), static_cast<long>(rng.below(sources.present.size())));
    };
    for (int step = 0; step < 400; ++step) {
      const SiteId id(static_cast<std::size_t>(rng.below(60)));
      if (sources.present.contains(id))
        sources.remove(id);
      else
        sources.insert(id, pool[rng.below(pool.size())]);
      if (sources.present.empty()) continue;
      const SiteId x = any_present();
      hidden += sources.triangulation.triangulation().is_hidden(x);
      sources.check_nearest(sources.points[x].position, x, x);                    // as a separation
      sources.check_nearest(pool[rng.below(pool.size())].position, SiteId(), x);  // from afar
      sources.check_nearest(pool[rng.below(pool.size())].position, any_present(), SiteId());
      sources.check_nearest(pool[rng.below(pool.size())].position, any_present(), any_present());
    }
  }
  CHECK(hidden > 100);
}

TEST_CASE("neighbour sources: rivals and heirs hold whoever is nearest to a location in the cell") {
  Rng rng(29);
  const std::vector<WeightedPoint3> pool = fixtures::draw(fixtures::Hardship::none, 60, false, rng);
  Sources sources(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  for (std::size_t i = 0; i < pool.size(); ++i) sources.insert(SiteId(i), pool[i]);
  std::vector<Vec3> locations(3000);
  for (Vec3& x : locations) x = fixtures::random_vector(rng);
  const auto set_reaches = [&] {
    for (const SiteId s : sources.present) {
      double reach = -std::numeric_limits<double>::infinity();
      for (const Vec3& x : locations)
        if (sources.nearest(x, SiteId()).site == s) reach = std::max(reach, power(x, sources.points[s]));
      sources.tree.set_reach(s, reach);
    }
  };
  for (const std::size_t i : {3, 17, 40}) {
    const SiteId p(i);
    const Vec3 center = sources.points[p].position;
    Vacancy vacancy{p, center, 0, 0};
    std::set<SiteId> heirs;
    for (const Vec3& x : locations) {
      if (sources.nearest(x, SiteId()).site != p) continue;
      const Nearest heir = sources.nearest(x, p);
      heirs.insert(heir.site);
      vacancy.radius = std::max(vacancy.radius, (x - center).norm());
      vacancy.max_radius2 = std::max(vacancy.max_radius2, heir.radius2);
    }
    sources.remove(p);
    set_reaches();
    std::vector<SiteId> named;
    for (const bool tree : {true, false}) {
      named.clear();
      tree ? sources.tree.heirs(vacancy, named) : sources.triangulation.heirs(vacancy, named);
      for (const SiteId heir : heirs) CHECK(std::ranges::count(named, heir) > 0);
    }
    sources.insert(p, pool[i]);
    for (const bool tree : {true, false}) {
      named.clear();
      tree ? sources.tree.rivals(p, named) : sources.triangulation.rivals(p, named);
      for (const SiteId rival : heirs) CHECK(std::ranges::count(named, rival) > 0);
    }
  }
}
