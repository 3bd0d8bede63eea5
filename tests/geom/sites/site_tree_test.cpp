#include "geom/sites/site_tree.h"

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

    // Of one that is not in: the same and, if it is where another one is, that too. Those of more reach are
    // among them.
    std::vector<SiteId> of_point;
    tree.rivals(own.point, of_point);
    std::erase(of_point, q);
    CHECK(of_point == rivals);
    const WeightedPoint3 stranger = random_site(rng).point;
    of_point.clear();
    tree.rivals(stranger, of_point);
    for (const auto& [s, site] : present) {
      if (site.reach + stranger.weight < 0) continue;
      const double limit =
          std::sqrt(site.reach + stranger.weight) + std::sqrt(std::max(0.0, site.reach + site.point.weight));
      if ((site.point.position - stranger.position).norm() < limit) CHECK(found(of_point, s));
    }
    for (const double least : {-1.0, 0.002, 0.01, 1.0}) {
      std::vector<SiteId> beyond;
      tree.rivals_beyond(least, stranger, beyond);
      for (const SiteId s : beyond) CHECK(found(of_point, s));
      for (const SiteId s : of_point)
        if (present.at(s).reach > least) CHECK(found(beyond, s));
      CHECK(std::ranges::all_of(beyond, [&](SiteId s) { return present.at(s).reach > least - 1e-6; }));
    }

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

TEST_CASE("site tree: points that somebody else has do as its own") {
  Rng rng(11);
  geom::Table<SiteId, geom::WeightedPoint3> points;
  SiteTree own, shared(points);
  for (int step = 0; step < 2000; ++step) {
    const SiteId p(static_cast<std::size_t>(rng.below(300)));
    const Site site = random_site(rng);
    if (p.index() >= points.size()) points.resize(p.index() + 1);
    const bool leaves = own.contains(p) && rng.below(2) == 0;
    for (SiteTree* tree : {&own, &shared}) {
      if (leaves) {
        tree->remove(p);
        continue;
      }
      points[p] = site.point;
      if (tree->contains(p))
        tree->move(p, site.point);
      else
        tree->insert(p, site.point);
      tree->set_reach(p, site.reach);
    }
    if (step % 20 != 0) continue;
    shared.check();
    const Vec3 x(rng.uniform(), rng.uniform(), rng.uniform());
    CHECK(own.nearest(x, p).site == shared.nearest(x, p).site);
    std::vector<SiteId> a, b;
    if (own.contains(p)) own.rivals(p, a), shared.rivals(p, b);
    CHECK(a == b);
  }
}

TEST_CASE("site tree: who moves is where it went, nearby or not, with the reach that was said last") {
  Rng rng(7);
  SiteTree tree;
  std::map<SiteId, Site> present;
  for (std::size_t i = 0; i < 300; ++i) {
    present[SiteId(i)] = random_site(rng);
    tree.insert(SiteId(i), present[SiteId(i)].point);
    tree.set_reach(SiteId(i), present[SiteId(i)].reach);
  }
  CHECK(!tree.contains(SiteId(300)));
  CHECK(!tree.contains(SiteId(5000)));
  for (int step = 0; step < 600; ++step) {
    const SiteId p(static_cast<std::size_t>(rng.below(300)));
    CHECK(tree.contains(p));
    const Site before = present[p];
    present[p] = random_site(rng);
    if (step % 4 == 1) present[p].point.position = before.point.position + Vec3(1e-3, 0, -1e-3);
    tree.move(p, present[p].point);
    CHECK(tree.contains(p));
    std::vector<SiteId> rivals;
    const SiteId other(p.value == 0 ? 1 : 0);
    tree.rivals(present[p].point, rivals);
    if (before.reach + present[p].point.weight > 1e-6) CHECK(found(rivals, p));
    if (step % 25 == 1) tree.check();
    tree.set_reach(p, present[p].reach);
    if (step % 25 != 0) continue;
    tree.check();
    CHECK(tree.nearest(present[p].point.position, other).radius2 <=
          power(present[p].point.position, present[p].point));
    double best = std::numeric_limits<double>::infinity();
    const Vec3 x(rng.uniform(), rng.uniform(), rng.uniform());
    for (const auto& [s, site] : present)
      if (s != other) best = std::min(best, power(x, site.point));
    CHECK(tree.nearest(x, other).radius2 == best);
  }
  tree.remove(SiteId(5));
  CHECK(!tree.contains(SiteId(5)));
}
