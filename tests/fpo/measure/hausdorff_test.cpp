#include "fpo/measure/hausdorff.h"

#include "doctest.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/rng.h"
#include "tests/fixtures/effort.h"
#include "tests/fixtures/surfaces.h"

namespace {

using doctest::Approx;
using fpo::surface_distance;
using fpo::SurfaceDistance;
using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

/// Turned so that nothing is axis-parallel, scaled, shifted.
TriMesh moved(const TriMesh& mesh, double scale = 1, const Vec3& shift = Vec3(0, 0, 0)) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  Table<VertexId, Vec3> vertices;
  for (const Vec3& p : mesh.vertices()) vertices.push_back(scale * (turn * p) + shift);
  return TriMesh(std::move(vertices), mesh.facets());
}

TriMesh sphere(int k) {
  const TriMesh blob = fixtures::blob(k);
  Table<VertexId, Vec3> vertices;
  for (const Vec3& p : blob.vertices()) vertices.push_back(p.normalized());
  return TriMesh(std::move(vertices), blob.facets());
}

/// Rectangles of k x k squares each, spanned at a corner.
TriMesh rectangles(const std::vector<std::array<Vec3, 3>>& spans, int k) {
  Table<VertexId, Vec3> v;
  Table<FacetId, TriMesh::Facet> f;
  for (const auto& [corner, x, y] : spans) fixtures::add_grid(v, f, k, corner, x, y);
  return TriMesh(std::move(v), std::move(f));
}
TriMesh hausdorff_square(int k, double height) {
  return rectangles({{Vec3(0, 0, height), Vec3(1, 0, 0), Vec3(0, 1, 0)}}, k);
}

/// The bound holds and is as tight as promised.
void check_gap(const SurfaceDistance& d, double diagonal) {
  CHECK(d.max <= d.max_bound);
  CHECK(d.max_bound <= d.max + std::max(1e-3 * d.max, 1e-6 * diagonal) + 1e-15 * diagonal);
  CHECK(d.rms <= d.max_bound);
}

/// The largest distance of the vertices and of random points of one surface to the other.
double sampled_distance(const TriMesh& from, const TriMesh& to, int per_facet) {
  const geom::AabbTree tree(to);
  geom::Rng rng(5);
  double largest2 = 0;
  for (const Vec3& x : from.vertices()) largest2 = std::max(largest2, tree.closest(x).distance2);
  for (FacetId t(0); t.index() < from.num_facets(); t = FacetId(t.value + 1))
    for (int i = 0; i < per_facet; ++i) {
      double u = rng.uniform(), v = rng.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 x = from.corner(t, 0) + u * (from.corner(t, 1) - from.corner(t, 0)) +
                     v * (from.corner(t, 2) - from.corner(t, 0));
      largest2 = std::max(largest2, tree.closest(x).distance2);
    }
  return std::sqrt(largest2);
}

}  // namespace

TEST_CASE("hausdorff: a surface is nowhere far from itself") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const SurfaceDistance d = surface_distance(mesh, mesh);
    CHECK(d.max_bound <= 1e-14 * mesh.diagonal());
    CHECK(d.rms <= 1e-14 * mesh.diagonal());
  }
}

TEST_CASE("hausdorff: nor from another triangulation of the same faces") {
  const TriMesh fine = moved(fixtures::box(Vec3(1, 1, 1), 13));
  for (const int k : {1, 5}) {
    const SurfaceDistance d = surface_distance(moved(fixtures::box(Vec3(1, 1, 1), k)), fine);
    CHECK(d.max_bound <= 1e-14);
  }
  CHECK(surface_distance(hausdorff_square(3, 0), hausdorff_square(7, 0)).max_bound <= 1e-14);
}

TEST_CASE("hausdorff: parallel squares") {
  for (const double h : {1e-9, 0.01, 3.0}) {
    const SurfaceDistance d = surface_distance(hausdorff_square(3, 0), hausdorff_square(4, h));
    CHECK(d.max == Approx(h));
    check_gap(d, std::sqrt(2));
    CHECK(d.rms == Approx(h));
  }
}

TEST_CASE("hausdorff: nested cubes are farthest at the corners") {
  const Vec3 size(1, 1, 1);
  const TriMesh inner = fixtures::box(size, 3), outer = fixtures::box(1.2 * size, 4);
  Table<VertexId, Vec3> centered;
  for (const Vec3& p : outer.vertices()) centered.push_back(p - 0.1 * size);
  const SurfaceDistance d = surface_distance(inner, TriMesh(std::move(centered), outer.facets()));
  CHECK(d.max == Approx(0.1 * std::sqrt(3)));
  check_gap(d, outer.diagonal());
}

TEST_CASE("hausdorff: the maximum may lie inside a facet, between two sheets") {
  const std::array<Vec3, 3> low{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const std::array<Vec3, 3> high{Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const std::array<Vec3, 3> strip{Vec3(0.4, 0.3, 0), Vec3(0.2, 0, 0),
                                  Vec3(0, 0.1, 1)};  // rises from one to the other
  const TriMesh with_strip = rectangles({low, high, strip}, 1), sheets = rectangles({low, high}, 2);
  const SurfaceDistance d = surface_distance(with_strip, sheets);
  CHECK(d.max == Approx(0.5).epsilon(1e-3));
  CHECK(d.max_bound >= 0.5);
  check_gap(d, sheets.diagonal());
  // min(z, 1 - z)^2 is 1/12 on the average over the strip, 0 on the sheets
  const double strip_area = strip[1].cross(strip[2]).norm();
  CHECK(d.rms == Approx(std::sqrt(strip_area / 12 / (2 + strip_area))).epsilon(1e-3));
}

TEST_CASE("hausdorff: a sphere against a finer one") {
  // Both have their vertices on the unit sphere, so the finer one lies between the coarse one and the sphere.
  const TriMesh coarse = sphere(4), fine = sphere(40);
  const auto sagitta = [](const TriMesh& mesh) {  // how far the mesh falls short of the sphere
    return 1 - std::sqrt(geom::AabbTree(mesh).closest(Vec3(0, 0, 0)).distance2);
  };
  const SurfaceDistance d = surface_distance(coarse, fine);
  CHECK(d.max <= sagitta(coarse));
  CHECK(d.max_bound >= sagitta(coarse) - sagitta(fine));
  check_gap(d, fine.diagonal());
}

TEST_CASE("hausdorff: no sample exceeds the bound, some come near the distance") {
  const std::vector<std::pair<TriMesh, TriMesh>> pairs{
      {fixtures::blob(5), fixtures::blob(9)},
      {fixtures::blob(8), moved(fixtures::blob(8))},
      {fixtures::box(Vec3(1, 1, 1), 3), moved(fixtures::box(Vec3(1, 1, 0.01), 4))},
      {fixtures::three_components(), fixtures::blob(5)}};
  const int grid = fixtures::effort(25, 50);
  for (const auto& [a, b] : pairs) {
    const SurfaceDistance d = surface_distance(a, b), reverse = surface_distance(b, a);
    check_gap(d, b.diagonal());
    check_gap(reverse, a.diagonal());
    CHECK(d.max <= reverse.max_bound);
    CHECK(reverse.max <= d.max_bound);
    CHECK(d.rms == Approx(reverse.rms));
    const double sampled = std::max(sampled_distance(a, b, grid), sampled_distance(b, a, grid));
    CHECK(sampled <= d.max_bound);
    CHECK(sampled >= 0.9 * d.max);
  }
}

TEST_CASE("hausdorff: the number of threads changes no bit") {
  const TriMesh a = fixtures::blob(9), b = moved(fixtures::blob(12));
  const SurfaceDistance one = surface_distance(a, b, 1);
  for (const int threads : {2, 5}) {
    const SurfaceDistance d = surface_distance(a, b, threads);
    CHECK(d.max == one.max);
    CHECK(d.max_bound == one.max_bound);
    CHECK(d.rms == one.rms);
  }
}

TEST_CASE("hausdorff: surfaces without area") {
  const TriMesh line({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)},
                     {{VertexId(0), VertexId(1), VertexId(2)}});
  const TriMesh above({Vec3(0, 3, 0), Vec3(1, 3, 0), Vec3(2, 3, 0)},
                      {{VertexId(0), VertexId(1), VertexId(2)}});
  const SurfaceDistance d = surface_distance(line, above);
  CHECK(d.max == 3);
  CHECK(d.max_bound == Approx(3));
  CHECK(d.rms == Approx(3));
  CHECK_THROWS_AS(surface_distance(TriMesh(), line), geom::InputError);
  CHECK_THROWS_AS(surface_distance(line, TriMesh()), geom::InputError);
}

TEST_CASE(
    "hausdorff: needles, whose length is out of all proportion to their area, need no endless quadrature") {
  Table<VertexId, Vec3> vertices;
  Table<FacetId, TriMesh::Facet> facets;
  for (int i = 0; i < fixtures::effort(5, 20); ++i) {
    const VertexId v = vertices.next_id();
    for (const Vec3& p : {Vec3(0, i, 0), Vec3(100, i, 0), Vec3(100, i + 1e-12, 0)}) vertices.push_back(p);
    facets.push_back({v, VertexId(v.value + 1), VertexId(v.value + 2)});
  }
  const TriMesh needles(vertices, facets);
  for (Vec3& p : vertices) p.z() = 0.25;
  const SurfaceDistance d = surface_distance(needles, TriMesh(vertices, facets));
  CHECK(d.max == Approx(0.25));
  CHECK(d.rms == Approx(0.25));
  check_gap(d, needles.diagonal());
}
