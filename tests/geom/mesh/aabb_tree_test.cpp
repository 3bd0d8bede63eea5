#include "geom/mesh/aabb_tree.h"

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

namespace {

using geom::AabbTree;
using geom::closest_point;
using geom::FacetId;
using geom::Rng;
using geom::Table;
using geom::TrianglePoint;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

Vec3 random_point(Rng& rng, double size) {
  const double x = rng.uniform(-size, size), y = rng.uniform(-size, size);
  return {x, y, rng.uniform(-size, size)};
}

AabbTree::Closest brute_force(const TriMesh& mesh, const Vec3& x) {
  AabbTree::Closest best;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const TrianglePoint p = closest_point(x, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
    if (p.distance2 < best.distance2) best = AabbTree::Closest{p, t};
  }
  return best;
}

/// Triangles anywhere, some without area, some twice.
TriMesh soup(Rng& rng, int count) {
  Table<VertexId, Vec3> vertices;
  Table<FacetId, TriMesh::Facet> facets;
  for (int i = 0; i < count; ++i) {
    const VertexId a = vertices.next_id();
    const Vec3 p = random_point(rng, 1);
    const double size = rng.uniform(0.01, 0.4);
    vertices.push_back(p);
    vertices.push_back(p + random_point(rng, size));
    vertices.push_back(rng.below(5) == 0 ? Vec3(2 * vertices.back() - p) : Vec3(p + random_point(rng, size)));
    const TriMesh::Facet facet{a, VertexId(a.value + 1), VertexId(a.value + 2)};
    facets.push_back(facet);
    if (rng.below(4) == 0) facets.push_back(facet);
  }
  return TriMesh(std::move(vertices), std::move(facets));
}

/// On the surface, at vertices, near, far.
std::vector<Vec3> queries(const TriMesh& mesh, Rng& rng, int count) {
  std::vector<Vec3> result;
  const double size = mesh.diagonal();
  for (int i = 0; i < count; ++i) {
    const FacetId t(static_cast<std::size_t>(rng.below(mesh.num_facets())));
    double u = rng.uniform(), v = rng.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 on = mesh.corner(t, 0) + u * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
                    v * (mesh.corner(t, 2) - mesh.corner(t, 0));
    result.insert(result.end(), {on, mesh.corner(t, 0), on + random_point(rng, 0.01 * size),
                                 on + random_point(rng, size), on + random_point(rng, 100 * size)});
  }
  return result;
}

/// y is nearest to x in a convex set exactly if no corner q lies beyond the plane through y that x - y is
/// normal to: e = (x - y).(q - y) <= 0. Else a step from y towards q gains e^2 / |q - y|^2 of squared
/// distance, and that can only be rounding.
void check_optimal(const Vec3& x, const std::array<Vec3, 3>& q, Rng& rng) {
  const TrianglePoint p = closest_point(x, q);
  const double size = (x - q[0]).norm() + (q[1] - q[0]).norm() + (q[2] - q[0]).norm();
  const double rounding = 1e-14 * size * size;
  for (const Vec3& corner : q) {
    const double e = (x - p.point).dot(corner - p.point);
    if (e > 0) REQUIRE(e * std::min(1.0, e / (corner - p.point).squaredNorm()) <= rounding);
  }
  for (int i = 0; i < 20; ++i) {
    const double u = rng.uniform(), v = rng.uniform() * (1 - u);
    const Vec3 other = q[0] + u * (q[1] - q[0]) + v * (q[2] - q[0]);
    REQUIRE(p.distance2 <= (x - other).squaredNorm() + rounding);
  }
  REQUIRE(p.distance2 == doctest::Approx((x - p.point).squaredNorm()).epsilon(1e-14));
  REQUIRE(p.barycentric.minCoeff() >= 0);
  REQUIRE(p.barycentric.sum() == doctest::Approx(1));
  const Vec3 combined = p.barycentric[0] * q[0] + p.barycentric[1] * q[1] + p.barycentric[2] * q[2];
  REQUIRE((combined - p.point).norm() <= 1e-14 * size);
}

}  // namespace

TEST_CASE("closest_point: optimal on triangles of every shape") {
  Rng rng(1);
  for (int round = 0; round < 20000; ++round) {
    std::array<Vec3, 3> q{random_point(rng, 1), random_point(rng, 1), random_point(rng, 1)};
    switch (rng.below(6)) {
      case 0:  // needle
        q[2] = q[0] + rng.uniform(-0.5, 1.5) * (q[1] - q[0]) +
               std::pow(10, rng.uniform(-17, -2)) * random_point(rng, 1);
        break;
      case 1:  // short edge
        q[1] = q[0] + std::pow(10, rng.uniform(-17, -2)) * random_point(rng, 1);
        break;
      case 2:
        q[1] = q[0];
        break;
      case 3:
        q[1] = q[2] = q[0];
        break;
      default:
        break;
    }
    const double away = std::pow(10, rng.uniform(-6, 2));
    const Vec3 x = q[rng.below(3)] + random_point(rng, away);
    CAPTURE(round);
    check_optimal(x, q, rng);
    for (const Vec3& corner : q) REQUIRE(closest_point(corner, q).distance2 == 0);
  }
}

TEST_CASE("closest_point: barycentric coordinates of each region") {
  const std::array<Vec3, 3> q{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  CHECK(closest_point(Vec3(0.25, 0.5, 7), q).barycentric.isApprox(Vec3(0.25, 0.25, 0.5)));
  CHECK(closest_point(Vec3(0.25, 0.5, 7), q).distance2 == 49);
  CHECK(closest_point(Vec3(0.25, -3, 0), q).barycentric.isApprox(Vec3(0.75, 0.25, 0)));
  CHECK(closest_point(Vec3(1, 1, 0), q).barycentric.isApprox(Vec3(0, 0.5, 0.5)));
  CHECK(closest_point(Vec3(2, -1, 4), q).barycentric == Vec3(0, 1, 0));
}

TEST_CASE("aabb_tree: to the bit what trying all facets gives") {
  Rng rng(2);
  auto cases = fixtures::surfaces();
  for (const int count : {1, 2, 5, 60, 300}) cases.push_back({"soup", soup(rng, count)});
  for (const auto& surface : cases) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const AabbTree tree(mesh);
    for (const Vec3& x : queries(mesh, rng, 100)) {
      const AabbTree::Closest expected = brute_force(mesh, x);
      const FacetId hint(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      for (const AabbTree::Closest& found : {tree.closest(x), tree.closest(x, hint)}) {
        REQUIRE(found.distance2 == expected.distance2);
        REQUIRE(found.facet == expected.facet);
        REQUIRE(found.point == expected.point);
        REQUIRE(found.barycentric == expected.barycentric);
      }
      for (const double bound : {0.0, 0.5 * expected.distance2, expected.distance2, 2 * expected.distance2,
                                 std::nextafter(expected.distance2, 1e300)})
        for (const FacetId near : {FacetId(), hint})
          REQUIRE(tree.is_nearer(x, bound, near) == (expected.distance2 < bound));
    }
  }
}

TEST_CASE("aabb_tree: of facets equally near the one of the smallest id") {
  const TriMesh cube = fixtures::box(Vec3(2, 2, 2), 4);
  const AabbTree tree(cube);
  for (VertexId v(0); v.index() < cube.num_vertices(); v = VertexId(v.value + 1)) {
    FacetId smallest;
    for (FacetId t(0); !smallest.valid(); t = FacetId(t.value + 1))
      for (const VertexId corner : cube.facet(t))
        if (corner == v) smallest = t;
    REQUIRE(tree.closest(cube.position(v)).facet == smallest);
    REQUIRE(tree.closest(cube.position(v), FacetId(cube.num_facets() - 1)).facet == smallest);
  }
  CHECK(tree.closest(Vec3(1, 1, 1)).distance2 == 1);
  CHECK_THROWS_AS(AabbTree{TriMesh()}, geom::InputError);
}
