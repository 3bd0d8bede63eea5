// Properties of the regular triangulation of the flat torus, on inputs made to be degenerate.

#include "geom/regular/regular2.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "doctest.h"
#include "geom/check.h"
#include "geom/hilbert.h"
#include "geom/rng.h"

using geom::Regular2;
using geom::Rng;
using geom::SimplexId;
using geom::SiteId;
using geom::Vec2;
using geom::WeightedPoint2;

namespace {

using Triangles = std::vector<Regular2::Triangle>;
using Points = std::vector<WeightedPoint2>;

Triangles sorted(Triangles t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Periods, a set of points, and where the next one goes. Half of the points stay, to fill the torus.
struct Kind {
  std::string name;
  Vec2 period;
  Points start;
  std::function<WeightedPoint2(Rng&)> draw;
};

/// One point in each simplex of an m x m grid.
Points jittered(int m, const Vec2& period, Rng& rng, const std::function<double(Rng&)>& weight) {
  Points points;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = (i + rng.uniform()) / m, v = (j + rng.uniform()) / m;
      points.push_back({Vec2(u, v).cwiseProduct(period), weight(rng)});
    }
  return points;
}

std::vector<Kind> kinds() {
  Rng rng(7);
  const auto none = [](Rng&) { return 0.0; };
  const auto some = [](Rng& r) { return r.uniform(0, 0.01); };
  const auto heavy = [](Rng& r) { return r.uniform(0, 0.05); };
  const auto anywhere = [](Vec2 period, auto weight) {
    return [=](Rng& r) {
      const double x = r.uniform(0, period.x()), y = r.uniform(0, period.y());
      return WeightedPoint2{{x, y}, weight(r)};
    };
  };
  const Vec2 unit(1, 1), oblong(1.7, 0.9);
  std::vector<Kind> all;
  all.push_back({"random", unit, jittered(7, unit, rng, none), anywhere(unit, none)});
  all.push_back({"oblong, weighted", oblong, jittered(7, oblong, rng, some), anywhere(oblong, some)});
  all.push_back({"many hidden", unit, jittered(7, unit, rng, heavy), anywhere(unit, heavy)});
  // Cocircular everywhere, and every point three times in the long run.
  const auto lattice = [](Rng& r) {
    const double x = static_cast<double>(r.below(8)) / 8, y = static_cast<double>(r.below(8)) / 8;
    return WeightedPoint2{{x, y}, 0};
  };
  Points grid;
  for (int i = 0; i < 64; ++i) grid.push_back({{(i % 8) / 8.0, (i / 8) / 8.0}, 0});
  all.push_back({"lattice, duplicates", unit, grid, lattice});
  const auto weighted_lattice = [=](Rng& r) {
    return WeightedPoint2{lattice(r).position, static_cast<double>(r.below(3)) / 64};
  };
  all.push_back({"lattice, tied weights", unit, grid, weighted_lattice});
  const auto seam = [=](Rng& r) {
    const double x = r.uniform(-0.02, 0.02), y = r.uniform(0, 1);
    return r.below(2) ? WeightedPoint2{{x, y}, some(r) / 8} : WeightedPoint2{{y, x}, some(r) / 8};
  };
  all.push_back({"near the seam", unit, jittered(7, unit, rng, none), seam});
  // Twelve cocircular points and the center of their circle, over and over.
  const auto circle = [](Rng& r) {
    const std::uint64_t k = r.below(13);
    if (k == 12) return WeightedPoint2{{0.5, 0.5}, 0};
    constexpr int x[] = {5, 4, 3, -3, -4, -5, -5, -4, -3, 3, 4, 5},
                  y[] = {0, 3, 4, 4, 3, 0, 0, -3, -4, -4, -3, 0};
    return WeightedPoint2{{0.5 + x[k] / 16.0, 0.5 + y[k] / 16.0}, 0};
  };
  all.push_back({"circle", unit, grid, circle});
  for (Kind& kind : all) rng.shuffle(std::span(kind.start));
  return all;
}

/// Removes x, unless that would leave a gap of half a period.
bool removed(Regular2& t, SiteId x) {
  try {
    t.remove(x);
    return true;
  } catch (const geom::InputError&) {
    t.check();
    return false;
  }
}

/// Inserts x at a place, or where it was if its edges would be half a period long there.
Regular2::Change inserted(Regular2& t, SiteId x, const WeightedPoint2& place, const WeightedPoint2& was) {
  try {
    return t.insert(x, place);
  } catch (const geom::InputError&) {
    t.check();
    return t.insert(x, was);
  }
}

/// By the definition: all counterclockwise triples whose circle excludes all copies of all other sites.
Triangles brute_force(const Regular2& t, const std::vector<SiteId>& present) {
  Triangles found;
  const Vec2& period = t.torus().period();
  for (const SiteId a : present) {
    const auto seen = [&](SiteId id) { return WeightedPoint2{t.difference(a, id), t.point(id).weight}; };
    const WeightedPoint2 pa = seen(a);
    const auto empty = [&](SiteId b, SiteId c) {
      const WeightedPoint2 pb = seen(b), pc = seen(c);
      if (geom::orient2(pa.position, pb.position, pc.position) <= 0) return false;
      for (const SiteId e : present) {
        if (e == a || e == b || e == c) continue;
        for (int copy = 0; copy < 9; ++copy) {
          WeightedPoint2 pe = seen(e);
          pe.position += Vec2((copy % 3 - 1) * period.x(), (copy / 3 - 1) * period.y());
          if (geom::conflicts2({&pa, a.value}, {&pb, b.value}, {&pc, c.value}, {&pe, e.value})) return false;
        }
      }
      return true;
    };
    for (const SiteId b : present)
      for (const SiteId c : present)
        if (a < b && a < c && b != c && empty(b, c)) found.push_back({a, b, c});
  }
  return sorted(found);
}

std::vector<SiteId> ids(std::size_t n) {
  std::vector<SiteId> all;
  for (std::size_t i = 0; i < n; ++i) all.emplace_back(i);
  return all;
}

Points points_of(const Regular2& t, std::size_t n) {
  Points all;
  for (const SiteId id : ids(n)) all.push_back(t.point(id));
  return all;
}

/// The triangles before a change, less the destroyed, plus the created, must be those after it.
struct Ledger {
  const Regular2& t;
  std::vector<Regular2::Triangle> by_cell;
  void sync() {
    by_cell.assign(t.simplex_capacity(), {});
    for (std::size_t k = 0; k < by_cell.size(); ++k)
      if (t.is_live(SimplexId(k))) by_cell[k] = t.corners(SimplexId(k));
  }
  bool explains(const Regular2::Change& change) {
    by_cell.resize(t.simplex_capacity(), {});
    for (const SimplexId c : change.destroyed) by_cell[c.index()] = {};
    for (const SimplexId c : change.created) by_cell[c.index()] = t.corners(c);
    const std::vector<Regular2::Triangle> recorded = by_cell;
    sync();
    return recorded == by_cell;
  }
};

}  // namespace

TEST_CASE("regular2: equals brute force after every move") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    Regular2 t(kind.period, kind.start);
    const std::vector<SiteId> present = ids(kind.start.size());
    t.check();
    CHECK(sorted(t.triangles()) == brute_force(t, present));
    Rng rng(3);
    for (int move = 0; move < 12; ++move) {
      CAPTURE(move);
      const SiteId x(static_cast<std::size_t>(rng.below(present.size() / 2)));
      const WeightedPoint2 was = t.point(x);
      if (!removed(t, x)) continue;
      t.check();
      inserted(t, x, kind.draw(rng), was);
      t.check();
      REQUIRE(sorted(t.triangles()) == brute_force(t, present));
    }
  }
}

TEST_CASE("regular2: local updates equal a rebuild, changes tell what happened") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    const std::size_t n = kind.start.size();
    Regular2 t(kind.period, kind.start);
    Ledger ledger{t, {}};
    ledger.sync();
    Rng rng(5);
    for (int move = 0; move < 300; ++move) {
      CAPTURE(move);
      const SiteId x(static_cast<std::size_t>(rng.below(n / 2)));
      const WeightedPoint2 was = t.point(x);
      const bool was_hidden = t.is_hidden(x);
      Regular2::Change removal;
      try {
        removal = t.remove(x);
      } catch (const geom::InputError&) {
        continue;
      }
      REQUIRE(ledger.explains(removal));
      REQUIRE(removal.hidden.empty());
      REQUIRE((!was_hidden || removal.exposed.empty()));
      for (const SiteId e : removal.exposed) REQUIRE(!t.is_hidden(e));
      const Regular2::Change insertion = inserted(t, x, kind.draw(rng), was);
      REQUIRE(ledger.explains(insertion));
      for (const SiteId h : insertion.hidden) REQUIRE(t.is_hidden(h));
      if (move % 10 != 0) continue;
      t.check();
      const Regular2 rebuilt(kind.period, points_of(t, n));
      REQUIRE(sorted(t.triangles()) == sorted(rebuilt.triangles()));
    }
  }
}

TEST_CASE("regular2: removal and insertion at the same place is the identity, radii included") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    Regular2 t(kind.period, kind.start);
    const auto state = [&] {
      std::vector<std::pair<Regular2::Triangle, double>> s;
      for (std::size_t k = 0; k < t.simplex_capacity(); ++k) {
        if (!t.is_live(SimplexId(k))) continue;
        Regular2::Triangle c = t.corners(SimplexId(k));
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        s.emplace_back(c, t.radius2(SimplexId(k)));
      }
      std::sort(s.begin(), s.end());
      return s;
    };
    const auto before = state();
    for (const SiteId x : ids(kind.start.size())) {
      const WeightedPoint2 p = t.point(x);
      if (!removed(t, x)) continue;
      t.insert(x, p);
      REQUIRE(state() == before);
    }
  }
}

TEST_CASE("regular2: a translation of the torus by a grid vector changes no triangle") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    const Regular2 t(kind.period, kind.start);
    const double grid = t.torus().grid();
    for (const Vec2& by :
         {Vec2(0.5, 0.25), Vec2(12345678901.0 * grid, 1234567.0 * grid), Vec2(grid, -3 * grid)}) {
      Points moved = points_of(t, kind.start.size());
      for (WeightedPoint2& p : moved) p.position += by;
      CHECK(sorted(Regular2(kind.period, moved).triangles()) == sorted(t.triangles()));
    }
  }
}

TEST_CASE("regular2: equal weights are no weights") {
  for (const Kind& kind : kinds()) {
    Points light = kind.start, heavy = kind.start;
    for (WeightedPoint2& p : light) p.weight = 0;
    for (WeightedPoint2& p : heavy) p.weight = 1;
    const Regular2 a(kind.period, light), b(kind.period, heavy);
    b.check();
    CHECK(sorted(a.triangles()) == sorted(b.triangles()));
  }
}

TEST_CASE("regular2: the nearest other site by search in all") {
  for (const Kind& kind : kinds()) {
    CAPTURE(kind.name);
    const Regular2 t(kind.period, kind.start);
    const std::vector<SiteId> present = ids(kind.start.size());
    for (const SiteId x : present) {
      double least = INFINITY;
      for (const SiteId y : present)
        if (y != x) least = std::min(least, t.difference(x, y).squaredNorm() - t.point(y).weight);
      CHECK(t.nearest_other(x).power == least);
    }
  }
}

TEST_CASE("regular2: thousands of sites, clustered, in sorted order of both kinds") {
  Rng rng(11);
  Points points = jittered(40, {3, 2}, rng, [](Rng& r) { return r.uniform(0, 1e-3); });
  for (int i = 0; i < 2000; ++i) {
    const double r = std::exp2(-rng.uniform(0, 40)), a = rng.uniform(0, 6.28);
    points.push_back({{1 + r * std::cos(a), 1 + r * std::sin(a)}, 0});
  }
  Regular2 t({3, 2}, points);
  t.check();
  for (int move = 0; move < 3000; ++move) {
    const SiteId x(static_cast<std::size_t>(rng.below(points.size())));
    t.remove(x);
    t.insert(x, {{rng.uniform(0, 3), rng.uniform(0, 2)}, rng.uniform(0, 1e-3)});
  }
  t.check();
  CHECK(sorted(t.triangles()) == sorted(Regular2({3, 2}, points_of(t, points.size())).triangles()));
}

TEST_CASE("regular2: what cannot be triangulated is refused, and nothing is changed") {
  using geom::InputError;
  CHECK_THROWS_AS(Regular2({0, 1}, Points{}), InputError);
  CHECK_THROWS_AS(Regular2({1, NAN}, Points{}), InputError);
  CHECK_THROWS_AS(Regular2({1, INFINITY}, Points{}), InputError);
  CHECK_THROWS_AS(Regular2({1, 1000}, Points{}), InputError);
  CHECK_THROWS_AS(Regular2({1, 1}, Points{}), InputError);
  CHECK_THROWS_AS(Regular2({1, 1}, Points(3, {{0.1, 0.1}, 0})), InputError);
  CHECK_THROWS_AS(Regular2({1, 1}, Points(100, {{0.1, NAN}, 0})), InputError);
  CHECK_THROWS_AS(Regular2({1, 1}, Points(100, {{0.1, 0.1}, INFINITY})), InputError);
  Rng rng(1);
  Points points = jittered(4, {1, 1}, rng, [](Rng&) { return 0.0; });
  Regular2 t({1, 1}, points);
  int refused = 0;
  for (const SiteId x : ids(points.size())) {
    const Triangles before = sorted(t.triangles());
    try {
      t.remove(x);
    } catch (const InputError&) {
      ++refused;
      t.check();
      CHECK(sorted(t.triangles()) == before);
    }
  }
  CHECK(refused > 0);
  CHECK_THROWS_AS(t.insert(SiteId(100), {{0.5, 0.5}, 2}), InputError);
  t.check();
}

TEST_CASE("hilbert: a curve without jumps through all simplices") {
  constexpr std::uint32_t side = 16, step = (1u << 20) / side;
  std::vector<std::pair<std::uint64_t, std::pair<int, int>>> simplices;
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j)
      simplices.push_back(
          {geom::hilbert_index(i * step, j * step), {static_cast<int>(i), static_cast<int>(j)}});
  std::sort(simplices.begin(), simplices.end());
  for (std::size_t k = 1; k < simplices.size(); ++k) {
    const auto [i, j] = simplices[k].second;
    const auto [i0, j0] = simplices[k - 1].second;
    CHECK(std::abs(i - i0) + std::abs(j - j0) == 1);
  }
}
