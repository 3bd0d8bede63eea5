#include "geom/dual/restricted_dual.h"

#include <algorithm>
#include <optional>

#include "doctest.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/mirrored_dual.h"
#include "tests/fixtures/whole_diagram.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace geom;
using fixtures::check_by_brute_force;
using fixtures::DualWalk;
using fixtures::MirroredDual;
using fixtures::Placed;
using fixtures::Weights;
using oracle::KnownCircle;

namespace {

/// The same sites in a dual that is built at once.
std::vector<KnownCircle> circles_if_built(const MirroredDual& d, int threads) {
  MirroredDual fresh(d.dual().mesh(), true, d.types());
  std::vector<Placed> samples;
  for (const SiteId p : d.present()) samples.push_back(d.placed(p));
  fresh.build(samples, threads);
  return fresh.known_circles();
}

/// Equal to a dual of the same sites that is built at once, whose reaches are the least bounds.
void check_by_rebuild(MirroredDual& d) {
  MirroredDual fresh(d.dual().mesh(), true, d.types());
  const std::vector<SiteId> present = d.present();
  std::vector<Placed> samples;
  for (const SiteId p : present) samples.push_back(d.placed(p));
  fresh.build(samples);
  REQUIRE(present.back().index() + 1 == present.size());  // the ids are the same
  REQUIRE(d.known_circles() == fresh.known_circles());
  d.dual().check();
  for (const SiteId p : present) {
    CAPTURE(p.value);
    REQUIRE(d.dual().has_cell(p) == fresh.dual().has_cell(p));
    if (!d.dual().has_cell(p)) continue;
    const double reach = fresh.dual().reach(p);
    REQUIRE(fresh.dual().least_reach(p) <= reach);
    const double slack = 1e-8 * (std::abs(reach) + std::abs(d.sites()[p].weight));
    REQUIRE(fresh.dual().reach_bound(p) <= reach + slack);
    REQUIRE(d.dual().reach_bound(p) >= reach - slack);
  }
}

/// Places with ties of all kinds: multiples of 1/4 on a box of whole sides.
std::vector<Placed> lattice_on(const TriMesh& box, double weight) {
  std::vector<Placed> pool;
  const Vec3 size = box.box().max();
  for (int x = 0; x <= 4; ++x)
    for (int y = 0; y <= 4; ++y)
      for (const int z : {0, 1}) {
        pool.push_back({{Vec3(x / 4.0 * size.x(), y / 4.0 * size.y(), z * size.z()), 0}, FacetId()});
        pool.push_back({{Vec3(z * size.x(), x / 4.0 * size.y(), y / 4.0 * size.z()), 0}, FacetId()});
        pool.push_back(
            {{Vec3(y / 4.0 * size.x(), z * size.y(), x / 4.0 * size.z()), x == y ? weight : 0}, FacetId()});
      }
  for (Placed& x : pool)  // a facet that it is on
    for (FacetId t(0); t.index() < box.num_facets() && !x.home.valid(); t = FacetId(t.value + 1))
      if (closest_point(x.point.position, {box.corner(t, 0), box.corner(t, 1), box.corner(t, 2)}).distance2 ==
          0)
        x.home = t;
  return pool;
}

double share(std::size_t part, std::size_t rest) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(part + rest, 1));
}

}  // namespace

TEST_CASE("restricted dual: equals brute force after every insertion, removal and move") {
  std::size_t at_once = 0;
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const bool search : {true, false})
        for (const auto& kind : {std::pair(CornerTypes::c_only, 1.0),
                                 {CornerTypes::c_only, 0.0},
                                 {CornerTypes::c_only, 0.9},
                                 {CornerTypes::all, 1.0}}) {
          CAPTURE(surface.name);
          CAPTURE(static_cast<int>(weights));
          CAPTURE(search);
          const auto [types, homes] = kind;
          CAPTURE(static_cast<int>(kind.first));
          CAPTURE(kind.second);
          DualWalk walk(surface.mesh,
                        {.weights = weights, .search = search, .types = types, .share_of_homes = homes});
          for (int step = 0; step < (surface.mesh.num_facets() > 100 ? 12 : 60); ++step) {
            CAPTURE(step);
            walk.step();
            check_by_brute_force(walk.d);
          }
          at_once += walk.moves_at_once();
        }
  CHECK(at_once > 500);
}

TEST_CASE("restricted dual: built at once and then moved, it equals brute force with either source") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const bool search : {true, false})
        for (const std::size_t n : {1u, 3u, 60u}) {
          CAPTURE(surface.name);
          CAPTURE(static_cast<int>(weights));
          CAPTURE(search);
          CAPTURE(n);
          DualWalk walk(surface.mesh,
                        {.num_sites = n, .weights = weights, .search = search, .keeps_number = true});
          walk.build();
          check_by_brute_force(walk.d);
          for (int step = 0; step < (surface.mesh.num_facets() > 100 ? 6 : 20); ++step) {
            CAPTURE(step);
            walk.step();
            check_by_brute_force(walk.d);
          }
        }
}

TEST_CASE(
    "restricted dual: built at once, it is the one that insertions lead to, with any number of threads") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all})
        for (const std::size_t n : {1u, 3u, 60u, 300u}) {
          CAPTURE(surface.name);
          CAPTURE(static_cast<int>(weights));
          CAPTURE(n);
          const std::vector<Placed> samples = fixtures::placed_samples(surface.mesh, n, n, weights, 9);
          MirroredDual one_by_one(surface.mesh, true, types);
          for (std::size_t i = n; i > 0; --i) one_by_one.insert(SiteId(i - 1), samples[i - 1]);
          const std::vector<KnownCircle> circles = one_by_one.known_circles();
          for (const int threads : {1, 2, 5}) CHECK(circles_if_built(one_by_one, threads) == circles);
        }
}

TEST_CASE("restricted dual: built by any number of threads, it has the same ids") {
  const TriMesh blob = fixtures::blob(20);
  const std::vector<Placed> samples = fixtures::placed_samples(blob, 3000, 3000, Weights::gentle, 4);
  MirroredDual by_one(blob, true, CornerTypes::all);
  by_one.build(samples, 1);
  for (const int threads : {2, 8}) {
    MirroredDual by_many(blob, true, CornerTypes::all);
    by_many.build(samples, threads);
    REQUIRE(by_many.circles() == by_one.circles());
    for (const CircleId c : by_one.circles()) {
      const EmptyCircle &a = by_one.dual().circle(c), &b = by_many.dual().circle(c);
      REQUIRE(std::tie(a.center, a.radius2, a.facet, a.sites, a.beyond, a.place, a.clockwise) ==
              std::tie(b.center, b.radius2, b.facet, b.sites, b.beyond, b.place, b.clockwise));
    }
    for (const SiteId p : by_one.present())
      CHECK(by_many.dual().reach_bound(p) == by_one.dual().reach_bound(p));
    CHECK(by_many.dual().known_cell(SiteId(0)).shape == CellShape::unknown);
    by_many.dual().certify();
    by_one.dual().certify();
    CHECK(by_many.dual().num_irregular() == by_one.dual().num_irregular());
    CHECK(by_many.dual().known_cell(SiteId(0)).shape != CellShape::unknown);
  }
}

TEST_CASE("restricted dual: sites on a lattice, on edges, on vertices and twice at one place") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 2), plate = fixtures::box(Vec3(1, 1, 0.125), 2);
  for (const TriMesh* const mesh : {&cube, &plate})
    for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all})
      for (const bool search : {true, false}) {
        CAPTURE(search);
        DualWalk walk(*mesh, {.num_sites = 16, .search = search, .types = types, .seed = 5},
                      lattice_on(*mesh, 0.0625));
        for (int step = 0; step < fixtures::effort(80, 150); ++step) {
          CAPTURE(step);
          walk.step();
          check_by_brute_force(walk.d);
        }
      }
}

TEST_CASE("restricted dual: remove and put back is the identity") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : {Weights::none, Weights::gentle})
      for (const bool search : {true, false}) {
        CAPTURE(surface.name);
        CAPTURE(search);
        MirroredDual d(surface.mesh, search, CornerTypes::c_only);
        const std::vector<Placed> samples = fixtures::placed_samples(surface.mesh, 120, 120, weights, 11);
        d.build(samples);
        const std::vector<KnownCircle> before = d.known_circles();
        for (std::size_t i = 0; i < samples.size(); ++i) {
          CAPTURE(i);
          d.remove(SiteId(i));
          d.insert(SiteId(i), samples[i]);
          REQUIRE(d.known_circles() == before);
          std::optional<PlannedRemoval> plan = d.dual().plan_removal(SiteId(i));
          if (!plan) continue;
          d.stay(*plan);
          d.dual().check();
          REQUIRE(d.known_circles() == before);
        }
      }
}

TEST_CASE("restricted dual: local updates equal a rebuild after each of hundreds of moves") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const bool search : {true, false}) {
      CAPTURE(surface.name);
      CAPTURE(search);
      DualWalk walk(surface.mesh,
                    {.num_sites = 80, .weights = Weights::gentle, .search = search, .keeps_number = true});
      walk.build();
      for (int step = 0; step < fixtures::effort(80, 150); ++step) {
        CAPTURE(step);
        walk.step();
        REQUIRE(walk.d.known_circles() == circles_if_built(walk.d, 1));
      }
      check_by_brute_force(walk.d);
    }
}

// Where all is fast, and where little is: bounds that were once raised or lowered wrongly would stay so for a
// while.
TEST_CASE(
    "restricted dual: after each of many moves circles are those of a rebuild, and reaches bound the cells") {
  const auto waves = [](double x, double y) { return 0.06 * std::sin(9 * x) * std::cos(8 * y); };
  const fixtures::NamedSurface surfaces[] = {{"torus", fixtures::torus(1, 0.4, {24, 14, true, true, 0.2})},
                                             {"sphere", make_shape("sphere", 5)},
                                             {"double torus", make_shape("double-torus", 12)},
                                             {"thin plate", fixtures::box(Vec3(1, 0.8, 0.01), 5)},
                                             {"waves", fixtures::sheet(14, 1, waves, 0.2)},
                                             {"cube", fixtures::box(Vec3(1, 1, 1), 4)}};
  std::size_t fast = 0, in_place = 0, general = 0;
  for (const auto& surface : surfaces)
    for (const Weights weights : {Weights::none, Weights::gentle, Weights::hiding})
      for (const std::size_t n : {std::size_t{25}, fixtures::effort<std::size_t>(60, 80)}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(weights));
        CAPTURE(n);
        DualWalk walk(surface.mesh, {.num_sites = n, .weights = weights, .keeps_number = true, .seed = n});
        walk.build();
        walk.spread(1);
        for (int step = 0; step < fixtures::effort(30, 100); ++step) {
          CAPTURE(step);
          if (step % 3 != 0)  // else bounds that are too large may hide one that is not raised
            for (const SiteId p : walk.d.present()) walk.d.dual().reach(p);
          walk.step();
          check_by_rebuild(walk.d);
        }
        const DualWays& ways = walk.d.dual().ways();
        fast += ways.fast_removals + ways.fast_insertions;
        in_place += ways.in_place;
        general += ways.general_insertions;
      }
  CHECK(fast > fixtures::effort<std::size_t>(500, 2000));
  CHECK(in_place > fixtures::effort<std::size_t>(25, 100));
  CHECK(general > fixtures::effort<std::size_t>(25, 100));
}

// Small steps keep most edges, large ones few.
TEST_CASE("restricted dual: the reach of a cell, and of an heir's beside one whose removal is planned") {
  std::size_t cells = 0, told = 0;  // by the circles alone, nearly
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : fixtures::all_weights) {
      CAPTURE(surface.name);
      CAPTURE(static_cast<int>(weights));
      constexpr std::size_t n = 40;
      DualWalk walk(surface.mesh, {.num_sites = n, .weights = weights, .keeps_number = true});
      MirroredDual& d = walk.d;
      walk.build();
      for (int step = 0; step < 60; ++step) walk.step();
      const fixtures::WholeDiagram whole(d);
      const auto is_close = [](double bound, double reach) {
        const double slack = 1e-8 * (std::abs(reach) + 1);
        return bound >= reach - slack && bound <= reach + slack;
      };
      for (std::size_t i = 0; i < n; ++i) {
        const SiteId p(i);
        const double expected = whole.power->reach(p), bound = d.dual().reach_bound(p);
        CHECK(bound >= expected - 1e-8 * (std::abs(expected) + 1));
        const double least = d.dual().least_reach(p), weight = d.sites()[p].weight;
        CHECK(least <= expected);
        ++cells;
        told += d.dual().has_cell(p) && least + weight > 0.8 * (expected + weight);
        CHECK((d.dual().has_cell(p) ? is_close(d.dual().reach(p), expected) : bound == expected));
        CHECK(d.dual().reach_bound(p) == d.dual().reach(p));
      }
      for (std::size_t i = 0; i < n; ++i) {
        auto plan = d.dual().plan_removal(SiteId(i));
        if (!plan) continue;
        for (const SiteId heir : std::vector<SiteId>(plan->heirs().begin(), plan->heirs().end())) {
          const double expected = whole.power->reach(heir), found = d.dual().reach(heir);
          CHECK((found == expected || is_close(found, expected)));
        }
        d.stay(*plan);
      }
      check_by_brute_force(d);
    }
  CHECK(2 * told > cells);
}

TEST_CASE("restricted dual: a cell has the polygons that it has in the whole diagram") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights weights : fixtures::all_weights)
      for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all}) {
        CAPTURE(surface.name);
        DualWalk walk(surface.mesh, {.num_sites = 40, .weights = weights, .types = types});
        walk.build();
        for (int step = 0; step < 40; ++step) walk.step();
        const auto cells = fixtures::WholeDiagram(walk.d).cells();
        for (const SiteId p : walk.d.present()) {
          std::vector<RestrictedPower::Canonical> cell;
          for (const FacetPolygon& part : walk.d.dual().cell(p)) {
            CHECK(part.owner == p);
            RestrictedPower::Canonical fragment{part.facet, p, {}};
            for (const PolygonCorner& corner : part.corners) fragment.labels.push_back(corner.edge);
            std::rotate(fragment.labels.begin(), std::ranges::min_element(fragment.labels),
                        fragment.labels.end());
            cell.push_back(std::move(fragment));
          }
          CHECK(std::ranges::is_sorted(cell));
          CHECK((cells.contains(p) ? cell == cells.at(p) : cell.empty()));
        }
      }
}

TEST_CASE("restricted dual: links, the nearest site, and who is in") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    DualWalk walk(surface.mesh, {.num_sites = 40, .weights = Weights::gentle, .types = CornerTypes::all});
    Rng rng(5);
    std::vector<SiteId> link;
    for (int step = 0; step < 200; ++step) {
      walk.step();
      const MirroredDual& d = walk.d;
      const std::vector<SiteId> present = d.present();
      CHECK(d.dual().num_sites() == present.size());
      for (std::size_t i = 0; i < 40; ++i) CHECK(d.dual().tree().contains(SiteId(i)) == d.is_in(SiteId(i)));
      if (present.empty()) continue;
      const SiteId p = present[rng.below(present.size())];
      CHECK(d.dual().site(p).position == d.sites()[p].position);
      CHECK(d.dual().site(p).weight == d.sites()[p].weight);
      std::set<SiteId> around;
      for (const KnownCircle& c : d.known_circles())
        if (std::ranges::count(c.name.sites, p) > 0) around.insert(c.name.sites.begin(), c.name.sites.end());
      around.erase(p);
      around.erase(SiteId());
      d.dual().link(p, link);
      CHECK(std::ranges::equal(link, around));
      const Vec3 x = d.sites()[present[rng.below(present.size())]].position;
      CHECK(d.dual().nearest(x, SiteId()).site == oracle::nearest(x, d.sites(), present));
    }
  }
}

TEST_CASE("restricted dual: no site, one site, two sites, twins") {
  const TriMesh sphere = make_shape("sphere", 2);
  for (const bool search : {true, false})
    for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all}) {
      MirroredDual d(sphere, search, types);
      const std::vector<Placed> samples = fixtures::placed_samples(sphere, 6, 6, Weights::none, 2);
      CHECK(d.known_circles().empty());
      CHECK(!d.dual().nearest(Vec3(0, 0, 1), SiteId()).site.valid());
      d.insert(SiteId(4), samples[0]);
      check_by_brute_force(d);
      CHECK(d.known_circles().size() == (types == CornerTypes::all ? sphere.num_vertices() : 0));
      CHECK(!d.dual().plan_removal(SiteId(4)));
      d.remove(SiteId(4));
      CHECK(d.circles().empty());
      CHECK(d.dual().num_irregular() == 0);
      d.insert(SiteId(4), samples[0]);
      d.insert(SiteId(1), samples[1]);
      check_by_brute_force(d);
      d.insert(SiteId(0), samples[1]);
      d.insert(SiteId(7), samples[1]);
      check_by_brute_force(d);
      CHECK(!d.dual().has_cell(SiteId(7)) + !d.dual().has_cell(SiteId(1)) + !d.dual().has_cell(SiteId(0)) ==
            2);
      for (const int p : {1, 0, 7, 4}) {
        d.remove(SiteId(p));
        check_by_brute_force(d);
      }
      CHECK(d.circles().empty());
      CHECK(d.dual().num_irregular() == 0);
    }
}

TEST_CASE(
    "restricted dual: a mesh without facets is bad input, a site outside of the box or a second build a "
    "bug") {
  CHECK_THROWS_AS(RestrictedDual(TriMesh(), CornerTypes::c_only), InputError);
  const TriMesh sphere = make_shape("sphere", 2);
  RestrictedDual dual(sphere, CornerTypes::c_only);
  CHECK_THROWS_AS(dual.insert(SiteId(0), {Vec3(3, 0, 0), 0}, FacetId()), Bug);
  MirroredDual d(sphere, true, CornerTypes::c_only);
  const std::vector<Placed> samples = fixtures::placed_samples(sphere, 6, 6, Weights::none, 2);
  d.build(samples);
  CHECK_THROWS_AS(d.build(samples), Bug);
}

// Else nothing here would say anything of the fast way.
TEST_CASE("restricted dual: on smooth surfaces the fast way is the rule, and it equals brute force") {
  const TriMesh sphere = make_shape("sphere", 6), torus = fixtures::torus(1, 0.4, {32, 20, true, true, 0.2});
  for (const TriMesh* const mesh : {&sphere, &torus})
    for (const Weights weights : {Weights::none, Weights::gentle})
      for (const bool search : {true, false}) {
        CAPTURE(search);
        CAPTURE(static_cast<int>(weights));
        constexpr std::size_t n = 250;
        DualWalk walk(*mesh, {.num_sites = n, .weights = weights, .search = search, .keeps_number = true});
        walk.build();
        walk.spread(2);
        if (weights == Weights::none) CHECK(walk.d.dual().num_irregular() == 0);
        const DualWays before = walk.d.dual().ways();
        for (int step = 0; step < fixtures::effort(500, 1000); ++step) {
          walk.step();
          if (step % 25 == 0) REQUIRE(walk.d.known_circles() == circles_if_built(walk.d, 1));
        }
        DualWays ways = walk.d.dual().ways();
        ways.in_place -= before.in_place;
        ways.fast_removals -= before.fast_removals;
        ways.fast_insertions -= before.fast_insertions;
        ways.general_removals -= before.general_removals;
        ways.general_insertions -= before.general_insertions;
        MESSAGE("in place ", ways.in_place, ", fast removals ", ways.fast_removals, ", general ",
                ways.general_removals, ", fast insertions ", ways.fast_insertions, ", general ",
                ways.general_insertions);
        const double least = weights == Weights::none ? 0.98 : 0.8;
        CHECK(share(ways.in_place + ways.fast_removals, ways.general_removals) > least);
        CHECK(share(ways.in_place + ways.fast_insertions, ways.general_insertions) > least);
        CHECK(ways.in_place > fixtures::effort<std::size_t>(25, 50));
      }
}

TEST_CASE("restricted dual: without homes, and with all corners, no fast way is taken") {
  const TriMesh sphere = make_shape("sphere", 4);
  for (const auto& [types, homes] : {std::pair(CornerTypes::c_only, 0.0), {CornerTypes::all, 1.0}}) {
    DualWalk walk(sphere, {.num_sites = 60, .types = types, .share_of_homes = homes, .keeps_number = true});
    walk.build();
    walk.d.dual().certify();
    CHECK(walk.d.dual().num_irregular() == 60);
    for (int step = 0; step < 100; ++step) walk.step();
    const DualWays& ways = walk.d.dual().ways();
    CHECK(ways.in_place + ways.fast_removals + ways.fast_insertions == 0);
    CHECK(ways.general_insertions >= ways.general_removals);
  }
}
