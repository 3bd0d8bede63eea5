// Sheets taken apart.

#include "geom/repair/split.h"

#include "doctest.h"
#include "geom/repair/clean.h"
#include "geom/repair/weld.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"
#include "tests/io/sample_meshes.h"

namespace {

using namespace fixtures;

TriMesh split(const TriMesh& mesh, geom::Fans fans = geom::Fans::split) {
  MeshArrays arrays = fixtures::arrays_of(mesh);
  geom::split_sheets(arrays.vertices, arrays.facets, fans);
  return arrays.take();
}

TriMesh welded_at_places(const TriMesh& mesh) {
  MeshArrays arrays = fixtures::arrays_of(mesh);
  geom::weld_borders(geom::exact_places(arrays.vertices), arrays.facets, geom::Crowds::weld);
  return arrays.take();
}

}  // namespace

TEST_CASE("split: manifolds stay as they are") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    CHECK(fixtures::identical(split(mesh), mesh));
    CHECK(fixtures::identical(split(mesh, geom::Fans::keep_open), mesh));
  }
}

TEST_CASE("split: a fin leaves the surface as it was") {
  Rng rng(5);
  const TriMesh box = fixtures::box(Vec3(1, 1, 1), 3);
  const geom::Topology t = geom::topology(split(fixtures::with_fins(box, 4, rng)));
  CHECK(t.manifold());
  CHECK(t.components == 5);
  CHECK(t.boundary_loops == 4);
  CHECK(t.euler == 2 + 4);
}

TEST_CASE("split: bodies that share an edge, a corner or a wall come apart") {
  Rng rng(6);
  const TriMesh a = fixtures::box(Vec3(1, 1, 1), 2);
  for (const Vec3& shift : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const TriMesh b = geom::mapped(a, [&](const Vec3& p) { return Vec3(p + shift); });
    const TriMesh both = geom::joined(a, b);
    const TriMesh shared = fixtures::weld(both.vertices(), both.facets());
    REQUIRE(!geom::topology(shared).manifold());
    for (const TriMesh& mesh : {shared, welded_at_places(fixtures::split_vertices(both, 0, rng))}) {
      const geom::Topology t = geom::topology(split(mesh));
      CHECK(t.manifold());
      CHECK(t.components == 2);
      CHECK(t.euler == 4);
      CHECK(t.boundary_edges == 0);
      CHECK(t.misoriented_edges == 0);
    }
  }
}

TEST_CASE("split: with a wall inside, the outside stays closed") {
  // A box cut in two by a wall: the two halves of the outside bend less than either with the wall.
  const TriMesh a = fixtures::box(Vec3(1, 1, 1), 2);
  MeshArrays mesh = fixtures::arrays_of(a);
  fixtures::add_grid(mesh.vertices, mesh.facets, 2, Vec3(0.5, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  const geom::Topology t = geom::topology(split(fixtures::weld(mesh.vertices, mesh.facets)));
  CHECK(t.manifold());
  CHECK(t.components == 2);
  CHECK(t.boundary_loops == 1);
  CHECK(t.euler == 3);
}

TEST_CASE("split: holes that meet in a vertex still do, if open fans are kept together") {
  // Six facets around a vertex, two of them missing.
  const TriMesh bow =
      fixtures::make_mesh({{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}},
                          {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 6}});
  CHECK(fixtures::identical(split(bow, geom::Fans::keep_open), bow));
  CHECK(geom::topology(split(bow)).manifold());
  CHECK(split(bow).num_vertices() == 8);
}

TEST_CASE("split: any triangles become manifold sheets; places and facets stay") {
  Rng rng(12);
  for (int round = 0; round < 400; ++round) {
    CAPTURE(round);
    MeshArrays soup;
    const std::size_t corners = 4 + rng.below(5);
    for (std::size_t i = 0; i < corners; ++i) soup.add(fixtures::random_direction(rng));
    for (std::size_t i = 0, count = 2 + rng.below(14); i < count; ++i) {
      TriMesh::Facet f;
      do
        for (VertexId& v : f) v = VertexId(rng.below(corners));
      while (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]);
      soup.facets.push_back(f);
    }
    const TriMesh mesh = geom::cleaned(soup.take()).mesh;
    const TriMesh sheets = split(mesh);
    CHECK(geom::topology(sheets).manifold());
    CHECK(sheets.area() == doctest::Approx(mesh.area()));
    CHECK(fixtures::identical(split(mesh), sheets));
    CHECK(sheets.num_facets() >= mesh.num_facets());
  }
}

TEST_CASE("split: a book of thousands of pages comes apart into as few sheets as there can be") {
  for (const int pages : {65, 3000}) {
    CAPTURE(pages);
    MeshArrays book;
    const VertexId low = book.add(Vec3(0, 0, 0)), high = book.add(Vec3(0, 0, 1));
    for (int i = 0; i < pages; ++i) {
      const double turn = 6 * static_cast<double>(i) / pages;
      const VertexId tip = book.add(Vec3(std::cos(turn), std::sin(turn), 0.5));
      book.add_triangle(low, high, tip);
    }
    const geom::Topology t = geom::topology(split(book.take()));
    CHECK(t.manifold());
    CHECK(t.components == static_cast<std::size_t>((pages + 1) / 2));
    CHECK(t.nonmanifold_edges == 0);
  }
}
