#include "geom/power/restricted_power.h"

#include <array>
#include <set>

#include "doctest.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/placed_samples.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace geom;
using fixtures::Weights;

namespace {

/// A diagram and the search that it was built with.
struct Built {
  Built(const TriMesh& mesh, const std::vector<WeightedPoint3>& points, int threads = 1)
      : sites(points.begin(), points.end()) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      present.emplace_back(i);
      tree.insert(SiteId(i), points[i]);
    }
    power = std::make_unique<RestrictedPower>(mesh, points, tree, threads);
  }
  Clipper::Sites sites;
  std::vector<SiteId> present;
  SiteTree tree;
  std::unique_ptr<RestrictedPower> power;
};

double polygon_area(std::span<const PolygonCorner> corners) {
  Vec3 sum(0, 0, 0);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (corners[k].point.position - corners[0].point.position)
               .cross(corners[k + 1].point.position - corners[0].point.position);
  return 0.5 * sum.norm();
}

double total_area(const RestrictedPower& power) {
  double sum = 0;
  std::array<PolygonCorner, 3> buffer;
  for (FacetId t(0); t.index() < power.mesh().num_facets(); t = FacetId(t.value + 1))
    for (const FragmentId f : power.fragments().of_facet(t))
      sum += polygon_area(power.fragments().corners(f, buffer));
  return sum;
}

/// Reaches are bounds, and no loose ones.
void check_reaches(const Built& d) {
  std::array<PolygonCorner, 3> buffer;
  const FragmentStore& fragments = d.power->fragments();
  for (const SiteId p : d.present) {
    double most = -std::numeric_limits<double>::infinity();
    for (const FragmentId f : fragments.of_cell(p))
      for (const PolygonCorner& corner : fragments.corners(f, buffer))
        most = std::max(most, power(corner.point.position, d.sites[p]));
    if (fragments.of_cell(p).empty()) {
      CHECK(d.power->reach(p) == most);
      continue;
    }
    const double slack = 1e-8 * (std::abs(most) + d.sites[p].weight);
    CHECK(d.power->reach(p) >= most - slack);
    CHECK(d.power->reach(p) <= most + slack + 1e-12);
  }
}

}  // namespace

TEST_CASE("restricted power diagram: equals brute force") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights kind : fixtures::all_weights)
      for (const std::size_t n : {1u, 2u, 24u, 100u}) {
        CAPTURE(surface.name);
        CAPTURE(static_cast<int>(kind));
        CAPTURE(n);
        const Built d(surface.mesh, points_of(fixtures::placed_samples(surface.mesh, n, n, kind, 3)));
        d.power->check();
        CHECK(d.power->canonical() == oracle::restricted_power_diagram(surface.mesh, d.sites, d.present));
        CHECK(total_area(*d.power) == doctest::Approx(surface.mesh.area()).epsilon(1e-9));
        check_reaches(d);
      }
}

TEST_CASE("restricted power diagram: sites on a lattice, on edges, on vertices and twice at one place") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 2);
  Rng rng(5);
  std::vector<WeightedPoint3> pool;  // multiples of 1/4 on the surface: all kinds of ties
  for (int x = 0; x <= 4; ++x)
    for (int y = 0; y <= 4; ++y)
      for (const int z : {0, 4}) {
        pool.push_back({Vec3(x, y, z) / 4, 0});
        pool.push_back({Vec3(z, x, y) / 4, 0});
        pool.push_back({Vec3(y, z, x) / 4, 0.0625});
      }
  for (int draw = 0; draw < 100; ++draw) {
    std::vector<WeightedPoint3> points;
    for (std::size_t n = 1 + rng.below(20); n > 0; --n) points.push_back(pool[rng.below(pool.size())]);
    const Built d(cube, points);
    d.power->check();
    REQUIRE(d.power->canonical() == oracle::restricted_power_diagram(cube, d.sites, d.present));
  }
}

TEST_CASE("restricted power diagram: the owner of a fragment is the nearest site at its middle") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    const Built d(surface.mesh,
                  points_of(fixtures::placed_samples(surface.mesh, 200, 200, Weights::gentle, 29)));
    std::array<PolygonCorner, 3> buffer;
    for (FacetId t(0); t.index() < surface.mesh.num_facets(); t = FacetId(t.value + 1))
      for (const FragmentId f : d.power->fragments().of_facet(t)) {
        const auto corners = d.power->fragments().corners(f, buffer);
        Vec3 middle(0, 0, 0);
        for (const PolygonCorner& c : corners)
          middle += c.point.position / static_cast<double>(corners.size());
        const SiteId nearest = oracle::nearest(middle, d.sites, d.present);
        CHECK(power(middle, d.sites[d.power->fragments().site(f)]) <=
              power(middle, d.sites[nearest]) + 1e-13);
      }
  }
}

TEST_CASE("restricted power diagram: built by any number of threads, it is laid out the same") {
  const TriMesh blob = fixtures::blob(20);
  const std::vector<WeightedPoint3> points =
      points_of(fixtures::placed_samples(blob, 3000, 3000, Weights::gentle, 9));
  const Built by_one(blob, points, 1);
  for (const int threads : {2, 8}) {
    const Built by_many(blob, points, threads);
    const FragmentStore &a = by_one.power->fragments(), &b = by_many.power->fragments();
    REQUIRE(a.size() == b.size());
    for (SiteId s(0); s.index() < points.size(); s = SiteId(s.value + 1)) {
      REQUIRE(std::ranges::equal(a.of_cell(s), b.of_cell(s)));
      for (const FragmentId f : a.of_cell(s))
        REQUIRE(std::ranges::equal(a.corners(f), b.corners(f),
                                   [](const PolygonCorner& c, const PolygonCorner& d) {
                                     return c.point.position == d.point.position && c.edge == d.edge;
                                   }));
    }
  }
}

// As if the site did not exist, on the facets of the cell: then the diagram is that of the others.
TEST_CASE("restricted power diagram: a cell given away whole leaves the diagram of the others") {
  std::size_t given = 0;
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Weights kind : fixtures::all_weights) {
      CAPTURE(surface.name);
      CAPTURE(static_cast<int>(kind));
      const std::vector<WeightedPoint3> points =
          points_of(fixtures::placed_samples(surface.mesh, 30, 30, kind, 31));
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Built d(surface.mesh, points);
        const std::span<const FragmentId> cell = d.power->fragments().of_cell(SiteId(i));
        const std::vector<FragmentId> fragments(cell.begin(), cell.end());
        if (!d.power->abandon(SiteId(i), fragments, {}, d.tree)) {
          CHECK(d.power->canonical() == oracle::restricted_power_diagram(surface.mesh, d.sites, d.present));
          continue;
        }
        ++given;
        d.power->check();
        std::vector<SiteId> others = d.present;
        std::erase(others, SiteId(i));
        REQUIRE(d.power->canonical() == oracle::restricted_power_diagram(surface.mesh, d.sites, others));
        CHECK(d.power->fragments().of_cell(SiteId(i)).empty());
      }
    }
  CHECK(given > 300);
}

TEST_CASE("restricted power diagram: who is excluded gets nothing of a cell that is given away") {
  const TriMesh blob = fixtures::blob(6);
  const std::vector<WeightedPoint3> points =
      points_of(fixtures::placed_samples(blob, 40, 40, Weights::none, 3));
  for (std::size_t i = 0; i < points.size(); ++i) {
    Built d(blob, points);
    const FragmentStore& fragments = d.power->fragments();
    const std::vector<FragmentId> cell(fragments.of_cell(SiteId(i)).begin(),
                                       fragments.of_cell(SiteId(i)).end());
    std::set<SiteId> neighbours;
    std::set<FacetId> facets;
    std::array<PolygonCorner, 3> buffer;
    for (const FragmentId f : cell) {
      facets.insert(fragments.facet(f));
      for (const PolygonCorner& c : fragments.corners(f, buffer))
        if (c.edge.is_site()) neighbours.insert(c.edge.site());
    }
    REQUIRE(neighbours.size() > 2);
    const SiteId excluded = *neighbours.begin();
    const auto area_of = [&](SiteId s) {
      double area = 0;
      for (const FragmentId f : fragments.of_cell(s)) area += polygon_area(fragments.corners(f, buffer));
      return area;
    };
    const double before = area_of(excluded);
    const auto canonical = d.power->canonical();
    if (!d.power->abandon(SiteId(i), cell, std::array{excluded}, d.tree)) {
      CHECK(d.power->canonical() == canonical);
      continue;
    }
    CHECK(area_of(excluded) == doctest::Approx(before).epsilon(1e-9));
    CHECK(fragments.of_cell(SiteId(i)).empty());
    CHECK(total_area(*d.power) == doctest::Approx(blob.area()).epsilon(1e-9));
  }
}
