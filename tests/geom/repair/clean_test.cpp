// Cleaning: what it mends, and all that it leaves alone.

#include "geom/repair/clean.h"

#include <cmath>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/repair/flat_facets.h"
#include "geom/repair/weld.h"
#include "geom/shapes/shapes.h"
#include "io/mesh_io.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"
#include "tests/io/sample_meshes.h"

namespace {

using namespace fixtures;
using geom::Cleaned;
using geom::topology;

void check_same_surface(const TriMesh& a, const TriMesh& b) {
  const geom::Topology s = topology(a), t = topology(b);
  CHECK(s.euler == t.euler);
  CHECK(s.vertices == t.vertices);
  CHECK(s.facets == t.facets);
  CHECK(s.components == t.components);
  CHECK(s.boundary_edges == t.boundary_edges);
  CHECK(t.manifold());
  CHECK(t.misoriented_edges == s.misoriented_edges);
}

}  // namespace

TEST_CASE("clean: sound surfaces come back as they are") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const Cleaned result = geom::cleaned(mesh);
    CHECK(!result.done.any());
    CHECK(geom::in_words(result.done) == "");
    CHECK(fixtures::identical(result.mesh, mesh));
  }
  for (const char* name : {"sphere", "torus", "double-torus", "tube", "moebius", "two-spheres", "joint"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    CHECK(fixtures::identical(geom::cleaned(mesh).mesh, mesh));
  }
  CHECK(geom::cleaned(TriMesh()).mesh.num_facets() == 0);
}

TEST_CASE("clean: the paper's models come back as they are") {
  for (const char* name : {"eight.obj", "joint.obj", "mask.obj", "homer.obj", "fandisk.obj", "bunny.obj"}) {
    const auto path = fixtures::model(name);
    if (!path) return;
    CAPTURE(name);
    const TriMesh mesh = io::read_mesh(*path);
    CHECK(fixtures::identical(geom::cleaned(mesh).mesh, mesh));
  }
}

TEST_CASE("clean: a soup of triangles becomes the surface that it was") {
  Rng rng(1);
  for (const char* name : {"sphere", "torus", "cube", "tube", "double-torus", "joint"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    const Cleaned result = geom::cleaned(fixtures::split_vertices(mesh, 0, rng));
    check_same_surface(mesh, result.mesh);
    CHECK(result.done.welded > mesh.num_facets());
    CHECK(result.mesh.num_vertices() == 3 * mesh.num_facets());  // none is taken away
    const Cleaned again = geom::cleaned(result.mesh);
    CHECK(!again.done.any());
  }
}

TEST_CASE("clean: borders that coincide but for rounding are welded, others are not") {
  Rng rng(12);
  for (const char* name : {"sphere", "cube", "tube", "joint"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    for (const double off : {1e-17, 1e-10, 1e-8}) {
      const Cleaned result = geom::cleaned(fixtures::split_vertices(mesh, off, rng));
      check_same_surface(mesh, result.mesh);
      CHECK(!geom::cleaned(result.mesh).done.any());
    }
    const TriMesh apart = fixtures::split_vertices(mesh, 1e-5, rng);
    CHECK(fixtures::identical(geom::cleaned(apart).mesh, apart));
  }
}

TEST_CASE("clean: two faces of a part whose common edge was rounded in two ways have one") {
  for (const double off : {6e-17, 1e-8, 2e-3}) {  // in the corners of one face; the last one is a slit
    TriMesh mesh = fixtures::box(Vec3(1, 1, 1), 4);
    MeshArrays parts;
    for (const bool top : {false, true}) {
      std::map<VertexId, VertexId> copies;
      for (TriMesh::Facet f : mesh.facets()) {
        const bool is_top = std::ranges::all_of(f, [&](VertexId v) { return mesh.vertices()[v].z() == 1; });
        if (is_top != top) continue;
        for (VertexId& v : f) {
          if (!copies.contains(v))
            copies[v] = parts.add(mesh.vertices()[v] + Vec3(0, 0, top ? (v.index() % 2 ? off : -off) : 0));
          v = copies[v];
        }
        parts.facets.push_back(f);
      }
    }
    const Cleaned result = geom::cleaned(parts.take());
    CHECK(result.done.welded == (off < 1e-6 ? 16 : 0));
    CHECK(topology(result.mesh).boundary_edges == (off < 1e-6 ? 0 : 32));
  }
}

TEST_CASE("clean: sheets that lie on one another are not welded, copies nor the two sides of one") {
  Rng rng(13);
  const TriMesh disk = geom::make_shape("wave-disk", 12);
  for (const bool turned : {false, true})
    for (const double off : {1e-12, 1e-8}) {
      TriMesh copy = geom::mapped(disk, [&](const Vec3& p) { return Vec3(p + off * random_direction(rng)); });
      if (turned) copy = fixtures::with_flips(copy, 1, rng);
      const TriMesh both = geom::joined(disk, copy);
      CHECK(fixtures::identical(geom::cleaned(both).mesh, both));
    }
}

TEST_CASE("clean: borders are welded by rounding all or not at all") {
  Rng rng(14);
  for (const char* name : {"torus", "cube", "moebius"})
    for (double off = 1e-8; off < 1e-5; off *= 1.5) {
      CAPTURE(name);
      CAPTURE(off);
      const TriMesh mesh = geom::make_shape(name, 6);
      const TriMesh soup = fixtures::split_vertices(mesh, off, rng);
      const Cleaned result = geom::cleaned(soup);
      if (result.done.welded > 0)
        CHECK(topology(result.mesh).boundary_edges == topology(mesh).boundary_edges);
      else
        CHECK(fixtures::identical(result.mesh, soup));
      if (off < 1e-7) CHECK(result.done.welded > 0);
      if (off > 1e-6) CHECK(result.done.welded == 0);
    }
}

TEST_CASE("clean: crowds of vertices within rounding are left at once") {
  Rng rng(15);
  MeshArrays fan;  // of loose facets
  for (int i = 0; i < 3000; ++i) {
    const auto rim = [&](double at) { return Vec3(std::cos(at), std::sin(at), 0); };
    const VertexId tip = fan.add(1e-8 * random_direction(rng));
    fan.facets.push_back({tip, fan.add(rim(i * 0.002)), fan.add(rim(i * 0.002 + 0.001))});
  }
  const TriMesh mesh = fan.take();
  CHECK(fixtures::identical(geom::cleaned(mesh).mesh, mesh));
}

TEST_CASE("clean: closed sheets that only touch stay apart") {
  const TriMesh a = fixtures::box(Vec3(1, 1, 1), 2);
  for (const Vec3& shift : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)}) {  // by a face, an edge, a corner
    const TriMesh b = geom::mapped(a, [&](const Vec3& p) { return Vec3(p + shift); });
    const TriMesh both = geom::joined(a, b);
    const Cleaned result = geom::cleaned(both);
    CHECK(fixtures::identical(result.mesh, both));
  }
}

TEST_CASE(
    "clean: where more than two border edges coincide they are left, and nothing becomes less manifold") {
  Rng rng(4);
  // Two cubes share an edge: as a soup, four facets meet there.
  const TriMesh a = fixtures::box(Vec3(1, 1, 1), 1);
  const TriMesh b = geom::mapped(a, [](const Vec3& p) { return Vec3(p + Vec3(1, 1, 0)); });
  const Cleaned result = geom::cleaned(fixtures::split_vertices(geom::joined(a, b), 0, rng));
  CHECK(result.done.crowded == 4);
  CHECK(topology(result.mesh).nonmanifold_edges == 0);
  // Three half planes.
  const TriMesh book = fixtures::make_mesh(
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {-1, 1, 0}, {0, 0, 0}, {0, 0, 1}, {-1, -1, 0}},
      {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  CHECK(fixtures::identical(geom::cleaned(book).mesh, book));
}

TEST_CASE("clean: welding random soups never makes an edge of more than two facets") {
  Rng rng(11);
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    MeshArrays soup;
    const std::size_t corners = 3 + rng.below(4);
    std::vector<Vec3> at;
    for (std::size_t i = 0; i < corners; ++i) at.push_back(fixtures::random_direction(rng));
    for (std::size_t i = 0, count = 2 + rng.below(12); i < count; ++i) {
      std::array<VertexId, 3> f;
      std::array<std::size_t, 3> chosen;
      do
        for (std::size_t& c : chosen) c = rng.below(corners);
      while (chosen[0] == chosen[1] || chosen[1] == chosen[2] || chosen[2] == chosen[0]);
      for (std::size_t k = 0; k < 3; ++k) f[k] = soup.add(at[chosen[k]]);
      soup.facets.push_back(f);
    }
    const TriMesh mesh = soup.take();
    const Cleaned result = geom::cleaned(mesh);
    CHECK(topology(result.mesh).nonmanifold_edges == 0);
    CHECK(fixtures::identical(geom::cleaned(mesh).mesh, result.mesh));
    std::set<std::array<VertexId, 3>> sets;
    for (TriMesh::Facet f : result.mesh.facets()) {
      std::ranges::sort(f);
      CHECK(sets.insert(f).second);
    }
  }
}

TEST_CASE("clean: repeated facets go, first come first kept") {
  const TriMesh mesh = geom::make_shape("sphere");
  Rng rng(2);
  const Cleaned result = geom::cleaned(fixtures::with_duplicates(mesh, 0.02, rng));
  CHECK(result.done.repeated > 0);
  CHECK(fixtures::identical(result.mesh, mesh));
}

TEST_CASE("clean: a body doubled onto itself is one body") {
  for (const char* name : {"sphere", "tube"}) {
    const TriMesh mesh = geom::make_shape(name);
    const Cleaned result = geom::cleaned(geom::joined(mesh, mesh));
    CHECK(result.done.doubled == mesh.num_facets());
    check_same_surface(mesh, result.mesh);
  }
  Rng rng(3);
  const TriMesh cube = fixtures::box(Vec3(1, 2, 3), 2);
  check_same_surface(cube, geom::cleaned(fixtures::split_vertices(geom::joined(cube, cube), 0, rng)).mesh);
}

TEST_CASE("clean: facets without area are flipped away, so that nothing opens") {
  // A tetrahedron with a vertex on an edge: the facet 0 4 1 has no area.
  const TriMesh mesh =
      fixtures::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}},
                          {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {1, 2, 3}, {2, 0, 3}});
  REQUIRE(topology(mesh).boundary_edges == 0);
  const Cleaned result = geom::cleaned(mesh);
  CHECK(result.done.flat == 1);
  check_same_surface(mesh, result.mesh);
  for (std::size_t t = 0; t < result.mesh.num_facets(); ++t) CHECK(result.mesh.area(FacetId(t)) > 0.1);
}

TEST_CASE("clean: facets with two corners at one place go, and the gap is welded") {
  // The pole of a sphere as exporters write it: a vertex for each meridian.
  MeshArrays cap;
  constexpr int n = 8;
  for (int i = 0; i < n; ++i) cap.add({0, 0, 1});
  for (int i = 0; i < n; ++i) cap.add({std::cos(i), std::sin(i), 0});
  for (int i = 0; i + 1 < n; ++i) {
    cap.add_triangle(VertexId(i), VertexId(n + i + 1), VertexId(i + 1));  // no area
    cap.add_triangle(VertexId(i), VertexId(n + i), VertexId(n + i + 1));
  }
  const Cleaned result = geom::cleaned(cap.take());
  const geom::Topology t = topology(result.mesh);
  CHECK(result.done.flat == n - 1);
  CHECK(t.facets == n - 1);
  CHECK(t.euler == 1);
  CHECK(t.boundary_loops == 1);
  CHECK(t.manifold());
}

TEST_CASE("clean: a mesh of nothing but faults is left to who uses it") {
  const TriMesh line = fixtures::make_mesh({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}, {{0, 1, 2}});
  CHECK(fixtures::identical(geom::cleaned(line).mesh, line));
}

TEST_CASE("clean: collinear() is exact") {
  CHECK(geom::collinear(Vec3(0, 0, 0), Vec3(0.25, 0.5, 0.75), Vec3(0.125, 0.25, 0.375)));
  CHECK(!geom::collinear(Vec3(0, 0, 0), Vec3(0.1, 0.2, 0.7), Vec3(0.3, 0.6, 2.1)));  // 3 * .1 is not .3
  CHECK(geom::collinear(Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(0, 0, 0)));
  CHECK(!geom::collinear(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0x1p-150, 0)));
}

namespace {

/// A triangle of that size that hangs on a vertex, pointing away from the mesh.
std::array<VertexId, 2> hang_on(MeshArrays& mesh, VertexId v, double size) {
  const Vec3 at = mesh.vertices[v], out = at.normalized(), across = out.unitOrthogonal();
  const VertexId a = mesh.add(at + size * (out - across / 2)), b = mesh.add(at + size * (out + across / 2));
  mesh.add_triangle(v, a, b);
  return {a, b};
}

}  // namespace

TEST_CASE("clean: crumbs that hang on vertices go, with what hangs on them, and nothing else does") {
  const TriMesh sphere = geom::make_shape("sphere", 12);
  const auto with = [&](auto&& add) {
    MeshArrays mesh{sphere.vertices(), sphere.facets()};
    add(mesh);
    return mesh.take();
  };
  const TriMesh fringe = with([](MeshArrays& mesh) {
    for (const int v : {3, 40, 77})  // a chain of three
      for (VertexId at(v); const double size : {0.01, 0.02, 0.015}) at = hang_on(mesh, at, size)[0];
  });
  REQUIRE(topology(fringe).nonmanifold_vertices == 9);
  const Cleaned result = geom::cleaned(fringe);
  CHECK(result.done.hanging == 9);
  CHECK(geom::in_words(result.done) == "dropped 9 crumbs that hang on vertices");
  CHECK(result.mesh.facets() == sphere.facets());
  CHECK(topology(result.mesh).euler == topology(fringe).euler);

  const auto stays = [](const TriMesh& mesh) { CHECK(fixtures::identical(geom::cleaned(mesh).mesh, mesh)); };
  stays(with([](MeshArrays& mesh) { hang_on(mesh, VertexId(7), 0.6); }));  // a part of its own
  stays(with([](MeshArrays& mesh) {                                        // hangs on nothing
    mesh.add_triangle(mesh.add({2, 0, 0}), mesh.add({2.01, 0, 0}), mesh.add({2, 0.01, 0}));
  }));
  stays(with([](MeshArrays& mesh) {  // closed
    const auto [a, b] = hang_on(mesh, VertexId(7), 0.01);
    const VertexId top = mesh.add(1.02 * mesh.vertices[VertexId(7)]);
    mesh.add_triangle(VertexId(7), b, top), mesh.add_triangle(b, a, top),
        mesh.add_triangle(a, VertexId(7), top);
  }));
  MeshArrays board;  // of black fields only: no part is larger than the others
  constexpr int k = 40;
  for (int i = 0; i <= k * (k + 1) + k; ++i) board.add(Vec3(i % (k + 1), i / (k + 1), 0));
  for (int i = 0; i < k; ++i)
    for (int j = i % 2; j < k; j += 2) {
      const int v = i * (k + 1) + j;
      board.add_triangle(VertexId(v), VertexId(v + 1), VertexId(v + k + 1));
    }
  stays(board.take());
}

TEST_CASE("clean: in words") {
  geom::Cleaning done;
  done.welded = 2;
  done.flat = 1;
  CHECK(geom::in_words(done) == "welded 2 pairs of border edges, removed 1 facet without area");
}
