// Borders found, polygons filled, holes closed.

#include "geom/repair/holes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctest.h"
#include "geom/repair/fill_polygon.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"
#include "tests/io/sample_meshes.h"

namespace {

using namespace fixtures;

constexpr double any_length = 1e30;

/// Without the facets whose middles are in a ball.
TriMesh without_ball(const TriMesh& mesh, const Vec3& center, double radius) {
  MeshArrays result = fixtures::arrays_of(mesh);
  result.facets.clear();
  for (const TriMesh::Facet& f : mesh.facets()) {
    const Vec3 middle = (mesh.position(f[0]) + mesh.position(f[1]) + mesh.position(f[2])) / 3;
    if ((middle - center).norm() > radius) result.facets.push_back(f);
  }
  return result.take();
}

double smallest_angle(const TriMesh& mesh, FacetId t) {
  double least = 4;
  for (int i = 0; i < 3; ++i) {
    const Vec3 u = mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i),
               v = mesh.corner(t, (i + 2) % 3) - mesh.corner(t, i);
    least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  return least * 180 / std::numbers::pi;
}

geom::HoleFilling holes_fill(MeshArrays& mesh, double length = any_length) {
  return geom::fill_holes(mesh.vertices, mesh.facets, {length, 0});
}

}  // namespace

TEST_CASE("border loops: as many as topology counts, with their lengths") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const auto loops = geom::border_loops(mesh.vertices(), mesh.facets());
    CHECK(loops.size() == geom::topology(mesh).boundary_loops);
    for (const geom::BorderLoop& loop : loops) CHECK(loop.simple);
  }
  const TriMesh square = fixtures::tilted_square(4);
  const auto loops = geom::border_loops(square.vertices(), square.facets());
  REQUIRE(loops.size() == 1);
  CHECK(loops[0].vertices.size() == 16);
  CHECK(loops[0].vector_area.norm() == doctest::Approx(square.area()));
}

TEST_CASE("border loops: two holes that meet in a vertex are two loops") {
  const TriMesh sphere = geom::make_shape("sphere");
  Rng rng(4);
  const TriMesh spoilt = fixtures::with_bow_ties(sphere, 3, rng);
  std::size_t threes = 0;
  for (const geom::BorderLoop& loop : geom::border_loops(spoilt.vertices(), spoilt.facets()))
    threes += loop.vertices.size() == 3;
  CHECK(threes >= 4);
  CHECK(threes % 2 == 0);
}

TEST_CASE("fill polygon: a flat polygon gets triangles of its area, whatever its shape") {
  std::vector<Vec3> corners;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2 * std::numbers::pi * i / 20, r = i % 2 == 0 ? 1 : 0.4;
    corners.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  const std::vector<Vec3> across(corners.size(), Vec3(0, 0, 1));
  const auto triangles = geom::filled({corners, across, [](std::size_t, std::size_t) { return false; }});
  REQUIRE(triangles.size() == 18);
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const double z = (corners[b] - corners[a]).cross(corners[c] - corners[a]).z();
    CHECK(z > 0);
    area += z / 2;
  }
  CHECK(area == doctest::Approx(10 * 0.4 * std::sin(2 * std::numbers::pi / 20)));
}

TEST_CASE("fill polygon: forbidden edges are avoided, or there is no filling") {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, across(4, Vec3(0, 0, 1));
  const auto not_02 = [](std::size_t i, std::size_t j) { return std::min(i, j) == 0 && std::max(i, j) == 2; };
  for (const auto& t : geom::filled({corners, across, not_02})) {
    const bool has_0 = std::ranges::find(t, 0u) != t.end(), has_2 = std::ranges::find(t, 2u) != t.end();
    CHECK(!(has_0 && has_2));
  }
  CHECK(geom::filled({corners, across, [](std::size_t, std::size_t) { return true; }}).empty());
}

TEST_CASE("fill polygon: long ones lose ears first") {
  std::vector<Vec3> corners;
  for (int i = 0; i < 700; ++i) {
    const double angle = 2 * std::numbers::pi * i / 700;
    corners.push_back({std::cos(angle), std::sin(angle), 0.1 * std::sin(3 * angle)});
  }
  const std::vector<Vec3> across(corners.size(), Vec3(0, 0, 1));
  const auto triangles = geom::filled({corners, across, [](std::size_t, std::size_t) { return false; }});
  CHECK(triangles.size() == 698);
}

TEST_CASE("holes: single lost facets come back") {
  const TriMesh mesh = geom::make_shape("torus");
  Rng rng(3);
  MeshArrays holed = fixtures::arrays_of(fixtures::with_holes(mesh, 0.005, rng));
  const geom::HoleFilling done = holes_fill(holed);
  CHECK(done.filled > 0);
  CHECK(done.left == 0);
  const TriMesh closed = holed.take();
  const geom::Topology t = geom::topology(closed);
  CHECK(t.boundary_edges == 0);
  CHECK(t.euler == 0);
  CHECK(t.misoriented_edges == 0);
  CHECK(closed.area() == doctest::Approx(mesh.area()).epsilon(1e-3));
}

TEST_CASE("holes: a large one is filled like its surroundings") {
  const TriMesh mesh = geom::make_shape("sphere", 20);
  const double r = mesh.box().max().x();
  MeshArrays holed = fixtures::arrays_of(without_ball(mesh, Vec3(0, 0, r), 0.6 * r));
  const std::size_t facets_before = holed.facets.size(), vertices_before = holed.vertices.size();
  const geom::HoleFilling done = holes_fill(holed);
  CHECK(done.filled == 1);
  CHECK(done.vertices > 10);
  const TriMesh closed = holed.take();
  const geom::Topology t = geom::topology(closed);
  CHECK(t.manifold());
  CHECK(t.boundary_edges == 0);
  CHECK(t.euler == 2);
  CHECK(t.misoriented_edges == 0);
  for (std::size_t v = vertices_before; v < closed.num_vertices(); ++v)  // a cap, not a lid
    CHECK(closed.position(VertexId(v)).norm() == doctest::Approx(r).epsilon(0.06));
  double sum = 0;
  for (std::size_t f = facets_before; f < closed.num_facets(); ++f) sum += smallest_angle(closed, FacetId(f));
  CHECK(sum / static_cast<double>(closed.num_facets() - facets_before) > 35);
  const double size = closed.area() / static_cast<double>(closed.num_facets());
  CHECK((closed.area() - mesh.area()) == doctest::Approx(0).epsilon(0.05 * mesh.area()));
  for (std::size_t f = facets_before; f < closed.num_facets(); ++f) CHECK(closed.area(FacetId(f)) < 4 * size);
}

TEST_CASE("holes: longer borders than asked for stay, and so does a triangle by itself") {
  const TriMesh tube = geom::make_shape("tube");
  MeshArrays open = fixtures::arrays_of(tube);
  const geom::HoleFilling none = holes_fill(open, 1e-3);
  CHECK(none.filled == 0);
  CHECK(none.left == 2);
  CHECK(none.longest_left > 0);
  CHECK(holes_fill(open).filled == 2);
  CHECK(geom::topology(open.take()).euler == 2);
  MeshArrays triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                      {{VertexId(0), VertexId(1), VertexId(2)}}};
  CHECK(holes_fill(triangle).filled == 0);
}
