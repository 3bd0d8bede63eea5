#include "geom/power/facet_cells.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/scaling.h"
#include "geom/power/restricted_power.h"
#include "geom/rng.h"
#include "geom/sites/point_tree.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/surfaces.h"
#include "tests/oracle/restricted_power_oracle.h"

using namespace geom;

namespace {

/// Sites in a search tree.
struct Sites {
  void add(const WeightedPoint3& point) {
    tree.insert(table.next_id(), point);
    present.push_back(table.next_id());
    table.push_back(point);
  }
  Clipper::Sites table;
  SiteTree tree;
  std::vector<SiteId> present;
};

Sites samples_with_weights(const TriMesh& mesh, std::size_t n, double share) {
  Sites sites;
  Rng rng(n);
  for (const fpo::SurfaceSample& s : fpo::random_samples(mesh, n, 5))
    sites.add({s.position, share * rng.uniform() * mesh.area() / static_cast<double>(n)});
  return sites;
}

using Found = std::vector<FacetPolygon>;
Found facet_cells_divided(FacetCells& cells, FacetId t) {
  const std::span<const FacetPolygon> found = cells.divide(t);
  return {found.begin(), found.end()};
}

bool facet_cells_same(const Found& a, const Found& b) {
  const auto same_corner = [](const PolygonCorner& c, const PolygonCorner& d) {
    return c.point.position == d.point.position && c.point.tolerance == d.point.tolerance && c.edge == d.edge;
  };
  return std::ranges::equal(a, b, [&](const FacetPolygon& p, const FacetPolygon& q) {
    return p.facet == q.facet && p.owner == q.owner && std::ranges::equal(p.corners, q.corners, same_corner);
  });
}

/// Against all sites clipping each other, facets in a random order.
void compare_with_oracle(const TriMesh& mesh, const Sites& sites) {
  const Clipper clipper(mesh, sites.table, extent_of(mesh));
  FacetCells cells(mesh, sites.table, clipper, sites.tree);
  std::vector<RestrictedPower::Canonical> all;
  std::vector<FacetId> order;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) order.emplace_back(t);
  Rng(1).shuffle(std::span(order));
  for (const FacetId t : order)
    for (const FacetPolygon& polygon : cells.divide(t)) {
      RestrictedPower::Canonical fragment{t, polygon.owner, {}};
      for (const PolygonCorner& corner : polygon.corners) fragment.labels.push_back(corner.edge);
      all.push_back(std::move(fragment));
    }
  std::ranges::sort(all);
  CHECK(all == oracle::restricted_power_diagram(mesh, sites.table, sites.present));
}

}  // namespace

TEST_CASE("facet cells: equal brute force") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const double share : {0.0, 0.3, 8.0})
      for (const std::size_t n : {1u, 2u, 7u, 150u}) {
        CAPTURE(surface.name);
        CAPTURE(share);
        CAPTURE(n);
        compare_with_oracle(surface.mesh, samples_with_weights(surface.mesh, n, share));
      }
}

TEST_CASE("facet cells: sites on a lattice, on edges, on vertices and twice at one place") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 2);
  for (const double weight : {0.0, 0.0625, 2.0}) {
    Sites sites;
    for (int twice = 0; twice < 2; ++twice)
      for (int x = 0; x <= 4; ++x)
        for (int y = 0; y <= 4; ++y)
          for (const int z : {0, 4}) {
            sites.add({Vec3(z, x, y) / 4, 0});
            sites.add({Vec3(y, z, x) / 4, (x + y) % 3 == 0 ? weight : 0});
          }
    compare_with_oracle(cube, sites);
  }
}

TEST_CASE("facet cells: pairs of sites an ulp apart") {
  const TriMesh mesh = fixtures::blob(6);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    Rng rng(seed);
    Sites sites;
    for (int pair = 0; pair < 8; ++pair) {
      const FacetId t(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      Vec3 x = fpo::location_in_facet(mesh, t, 0.5, 0).position;
      sites.add({x, 0});
      double& c = x[static_cast<int>(rng.below(3))];
      c = std::nextafter(c, rng.below(2) == 0 ? -1.0 : 1.0);
      sites.add({snapped(x), 0});
    }
    compare_with_oracle(mesh, sites);
  }
}

TEST_CASE("facet cells: clusters far smaller than facets, and weights far larger than distances") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 1);
  for (const double weight : {0.0, -0.5, 0.5, 1.0, 100.0})
    for (const double size : {1e-4, 1e-6, 1e-8})
      for (const double x : {0.25, 0.5})
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
          CAPTURE(weight);
          CAPTURE(size);
          CAPTURE(seed);
          Sites sites = samples_with_weights(cube, 10, 0);
          Rng rng(seed);
          for (int i = 0; i < 50; ++i)
            sites.add({Vec3(x + size * rng.uniform(-1, 1), 0.5 + size * rng.uniform(-1, 1), 0),
                       weight + (seed % 2) * size * size * rng.uniform()});
          compare_with_oracle(cube, sites);
        }
}

TEST_CASE("facet cells: one sparse place does not make all others slow") {
  // Many samples on a ball and a triangle far away, which is facet_cells_divided first or last.
  for (const double side : {-1.0, 1.0}) {
    const TriMesh ball = fixtures::blob(10);
    Table<VertexId, Vec3> vertices = ball.vertices();
    Table<FacetId, TriMesh::Facet> facets = ball.facets();
    const VertexId a = vertices.next_id(), b(a.value + 1), c(a.value + 2);
    for (const Vec3& p : {Vec3(40, 0, 0), Vec3(40.1, 0, 0), Vec3(40, 0.1, 0)}) vertices.push_back(side * p);
    facets.push_back({a, b, c});
    const TriMesh mesh(std::move(vertices), std::move(facets));
    const Sites sites = samples_with_weights(ball, 4000, 0);
    const Clipper clipper(mesh, sites.table, extent_of(mesh));
    FacetCells cells(mesh, sites.table, clipper, sites.tree);
    std::size_t fragments = 0;
    for (const FacetId t : facets_along_curve(mesh)) fragments += cells.divide(t).size();
    CHECK(fragments > 4000);
    CHECK(cells.sites_looked_at() < 100 * 4000);
  }
}

TEST_CASE("facet cells: the answer does not depend on the facets before") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const Sites sites = samples_with_weights(surface.mesh, 200, 0.3);
    const Clipper clipper(surface.mesh, sites.table, extent_of(surface.mesh));
    FacetCells cells(surface.mesh, sites.table, clipper, sites.tree);
    for (std::size_t t = surface.mesh.num_facets(); t-- > 0;) {
      FacetCells fresh(surface.mesh, sites.table, clipper, sites.tree);
      CHECK(facet_cells_same(facet_cells_divided(cells, FacetId(t)), facet_cells_divided(fresh, FacetId(t))));
    }
  }
}

TEST_CASE("facet cells: the answer does not depend on who finds the sites") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const std::size_t n : {1u, 9u, 200u}) {
      CAPTURE(surface.name);
      CAPTURE(n);
      const Sites sites = samples_with_weights(surface.mesh, n, 0);
      std::vector<Vec3> positions;
      for (const SiteId s : sites.present) positions.push_back(sites.table[s].position);
      const PointTree tree(positions);
      const Clipper clipper(surface.mesh, sites.table, extent_of(surface.mesh));
      FacetCells cells(surface.mesh, sites.table, clipper, sites.tree);
      FacetCells others(surface.mesh, sites.table, clipper, tree);
      for (FacetId t(0); t.index() < surface.mesh.num_facets(); t = FacetId(t.value + 1))
        CHECK(facet_cells_same(facet_cells_divided(cells, t), facet_cells_divided(others, t)));
    }
}

TEST_CASE("facet cells: degenerate are facets whose corners lie on one line exactly") {
  const auto facet = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return TriMesh({a, b, c}, {{VertexId(0), VertexId(1), VertexId(2)}});
  };
  const Vec3 a(0.1, 0.2, 0.3), b(0.4, 0.8, 0.9);
  CHECK(is_degenerate(facet(a, b, a), FacetId(0)));
  CHECK(is_degenerate(facet(Vec3(1, 2, 4), Vec3(2, 4, 8), Vec3(3, 6, 12)), FacetId(0)));
  CHECK(is_degenerate(facet(Vec3(0, 0, 1), Vec3(0, 0, 2), Vec3(0, 0, 4)), FacetId(0)));
  for (int i = 0; i < 3; ++i) {
    Vec3 c = Vec3(3, 6, 12);
    c[i] = std::nextafter(c[i], 100.0);
    CHECK(!is_degenerate(facet(Vec3(1, 2, 4), Vec3(2, 4, 8), c), FacetId(0)));
    c = Vec3(0, 0, 4);
    c[i] = std::nextafter(c[i], 100.0);
    CHECK(is_degenerate(facet(Vec3(0, 0, 1), Vec3(0, 0, 2), c), FacetId(0)) == (i == 2));
  }
}
