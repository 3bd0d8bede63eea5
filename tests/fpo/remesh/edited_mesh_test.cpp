// Flips and moves on trial against what the mesh says when it is built anew.

#include "fpo/remesh/edited_mesh.h"

#include <algorithm>
#include <cmath>

#include "doctest.h"
#include "geom/mesh/surface_type.h"
#include "geom/rng.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

VertexId any_vertex(const EditedMesh& mesh, geom::Rng& rng) {
  return VertexId(static_cast<std::size_t>(rng.uniform() * static_cast<double>(mesh.num_vertices())));
}

/// A corner of a facet at v, in turn.
VertexId any_neighbour(const EditedMesh& mesh, VertexId v, geom::Rng& rng) {
  const std::vector<FacetId>& around = mesh.facets_at(v);
  const auto k = static_cast<std::size_t>(rng.uniform() * static_cast<double>(around.size()));
  return mesh.third(around[k], v, v);
}

void require_consistent(const EditedMesh& edited) {
  for (FacetId t(0); t.index() < edited.num_facets(); t = FacetId(t.value + 1)) {
    const TriMesh::Facet& f = edited.facet(t);
    for (std::size_t i = 0; i < 3; ++i) {
      REQUIRE(edited.beside(f[i], f[(i + 1) % 3]) == t);
      REQUIRE(edited.has_edge(f[(i + 1) % 3], f[i]));
      REQUIRE(std::ranges::is_sorted(edited.facets_at(f[i])));
      REQUIRE(std::ranges::find(edited.facets_at(f[i]), t) != edited.facets_at(f[i]).end());
    }
  }
}

}  // namespace

TEST_CASE("edited mesh: flips keep the topological type, and all is undone") {
  for (const char* name : {"sphere", "torus"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name, 8);
    EditedMesh edited(mesh);
    const TriMesh before = edited.mesh();
    geom::Rng rng(7);
    int flips = 0;
    for (int k = 0; k < 300; ++k) {
      const VertexId a = any_vertex(edited, rng), b = any_neighbour(edited, a, rng);
      if (!edited.can_flip(a, b)) continue;
      const VertexId c = edited.third(edited.beside(a, b), a, b), d = edited.third(edited.beside(b, a), a, b);
      edited.flip(a, b);
      CHECK(edited.has_edge(c, d));
      CHECK(!edited.has_edge(a, b));
      if (k % 3 == 0) edited.move(a, edited.position(a) + Vec3(0.1, 0, 0));
      ++flips;
    }
    CHECK(flips > 100);
    require_consistent(edited);
    const geom::Topology then = geom::topology(edited.mesh()), now = geom::topology(mesh);
    CHECK(then.manifold());
    CHECK(then.euler == now.euler);
    CHECK(then.misoriented_edges == 0);
    CHECK(!(edited.mesh().facets() == before.facets()));
    edited.undo_to(0);
    CHECK(edited.mesh().facets() == before.facets());
    CHECK(edited.mesh().vertices() == mesh.vertices());
    require_consistent(edited);
  }
}

TEST_CASE("edited mesh: what would make an edge twice, or has one facet only, is not flipped") {
  geom::Table<VertexId, Vec3> corners;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) corners.push_back(p);
  geom::Table<FacetId, TriMesh::Facet> sides;
  for (const std::array<int, 3>& f : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
    sides.push_back({VertexId(f[0]), VertexId(f[1]), VertexId(f[2])});
  const EditedMesh tetrahedron{TriMesh(corners, sides)};
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b)
      if (a != b) CHECK(!tetrahedron.can_flip(VertexId(a), VertexId(b)));
  geom::Table<VertexId, Vec3> vertices;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) vertices.push_back(p);
  geom::Table<FacetId, TriMesh::Facet> facets;
  facets.push_back({VertexId(0), VertexId(1), VertexId(2)});
  facets.push_back({VertexId(0), VertexId(2), VertexId(3)});
  EditedMesh square{TriMesh(vertices, facets)};
  CHECK(square.is_on_border(VertexId(0)));
  CHECK(!square.can_flip(VertexId(0), VertexId(1)));
  REQUIRE(square.can_flip(VertexId(0), VertexId(2)));
  square.flip(VertexId(0), VertexId(2));
  CHECK(square.has_edge(VertexId(1), VertexId(3)));
  CHECK(square.normal(FacetId(0)).z() == 1);
  CHECK(square.normal(FacetId(1)).z() == 1);
}

TEST_CASE("edited mesh: splits and collapses keep the topological type, down to the smallest of it") {
  struct Case {
    const char* name;
    std::size_t vertices;  ///< that a surface of this type cannot do without
  };
  for (const Case& c : {Case{"sphere", 4}, {"torus", 7}, {"square", 3}}) {
    CAPTURE(std::string(c.name));
    const TriMesh mesh = geom::make_shape(c.name, 6);
    const geom::SurfaceType type = geom::surface_type(mesh);
    EditedMesh edited(mesh);
    geom::Rng rng(3);
    for (int k = 0; k < 30; ++k) {
      const VertexId a = any_vertex(edited, rng), b = any_neighbour(edited, a, rng);
      const FacetId t = edited.facets_at(a).front();
      const std::size_t facets = edited.num_facets();
      const VertexId on_edge = edited.split(a, b, (edited.position(a) + edited.position(b)) / 2);
      CHECK(edited.num_facets() - facets == edited.facets_at(on_edge).size() / 2);
      CHECK(!edited.has_edge(a, b));
      const VertexId inside = edited.split(t, edited.position(a));
      CHECK(edited.facets_at(inside).size() == 3);
    }
    require_consistent(edited);
    CHECK(geom::surface_type(edited.mesh()).parts == type.parts);
    bool any = true;
    while (any) {
      any = false;
      for (VertexId v(0); v.index() < edited.num_vertices(); v = VertexId(v.value + 1))
        for (const VertexId w : edited.neighbours(v)) {
          if (!edited.can_collapse(v, w)) continue;
          edited.collapse(v, w);
          any = true;
          CHECK(edited.facets_at(v).empty());
          if (v.value % 16 == 0) CHECK(geom::surface_type(edited.mesh()).parts == type.parts);
          break;
        }
    }
    CHECK(geom::surface_type(edited.mesh()).parts == type.parts);
    const geom::Topology least = geom::topology(edited.mesh());
    CHECK(least.manifold());
    CHECK(least.vertices >= c.vertices);
    CHECK(least.vertices <= c.vertices + 3);  // which collapses come first may leave some
  }
}

TEST_CASE("edited mesh: a ring of three edges around a tube, or about a hole, is not pinched") {
  EditedMesh tube(geom::revolved({{1, 0}, {1, 1}, {1, 2}}, false, 3));
  for (VertexId v(0); v.index() < tube.num_vertices(); v = VertexId(v.value + 1))
    for (const VertexId w : tube.neighbours(v)) {
      const double rise = std::abs(tube.position(v).z() - tube.position(w).z());
      if (rise < 0.5) CHECK(!tube.can_collapse(v, w));
    }
}
