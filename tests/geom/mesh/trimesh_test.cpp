#include "geom/mesh/trimesh.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "doctest.h"
#include "geom/check.h"
#include "io/mesh_io.h"
#include "tests/fixtures/connections.h"
#include "tests/fixtures/models.h"
#include "tests/fixtures/surfaces.h"

namespace {

using fixtures::connections;
using geom::FacetId;
using geom::Table;
using geom::Topology;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

/// A torus of k x k squares.
TriMesh torus(int k) {
  std::vector<std::array<int, 3>> triangles;
  const auto at = [k](int i, int j) { return (i % k) * k + j % k; };
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return connections(static_cast<std::size_t>(k * k), triangles);
}

/// How the facets of each edge are found without sorting: edge -> (facet, its edge, ascending).
struct Side {
  FacetId facet;
  int edge;
  bool ascending;
};
std::map<std::pair<VertexId, VertexId>, std::vector<Side>> edges_of(const TriMesh& mesh) {
  std::map<std::pair<VertexId, VertexId>, std::vector<Side>> edges;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const VertexId a = mesh.facet(t)[static_cast<std::size_t>(e)],
                     b = mesh.facet(t)[static_cast<std::size_t>((e + 1) % 3)];
      edges[std::minmax(a, b)].push_back({t, e, a < b});
    }
  return edges;
}

/// Connected parts of a graph, by repeated walks.
std::size_t count_parts(const std::map<int, std::set<int>>& graph) {
  std::set<int> seen;
  std::size_t parts = 0;
  for (const auto& [start, ignored] : graph) {
    if (seen.contains(start)) continue;
    ++parts;
    std::vector<int> stack{start};
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      if (!seen.insert(at).second) continue;
      for (const int next : graph.at(at)) stack.push_back(next);
    }
  }
  return parts;
}

/// The definition: the edges opposite to a vertex form one path or one cycle.
bool link_is_manifold(const TriMesh& mesh, VertexId v) {
  std::map<int, std::set<int>> link;
  std::map<int, int> degree;
  for (const TriMesh::Facet& f : mesh.facets()) {
    const auto at = std::ranges::find(f, v) - f.begin();
    if (at == 3) continue;
    const int a = f[static_cast<std::size_t>((at + 1) % 3)].value,
              b = f[static_cast<std::size_t>((at + 2) % 3)].value;
    link[a].insert(b), link[b].insert(a);
    ++degree[a], ++degree[b];
  }
  return count_parts(link) <= 1 && std::ranges::all_of(degree, [](const auto& d) { return d.second <= 2; });
}

void check_against_definitions(const TriMesh& mesh) {
  const Topology t = topology(mesh);
  const auto edges = edges_of(mesh);
  std::size_t boundary = 0, nonmanifold = 0, misoriented = 0;
  std::map<int, std::set<int>> graph, boundary_graph;
  for (const auto& [ends, sides] : edges) {
    const int a = ends.first.value, b = ends.second.value;
    graph[a].insert(b), graph[b].insert(a);
    if (sides.size() == 1) boundary_graph[a].insert(b), boundary_graph[b].insert(a);
    boundary += sides.size() == 1;
    nonmanifold += sides.size() > 2;
    misoriented += sides.size() == 2 && sides[0].ascending == sides[1].ascending;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const FacetId expected = sides.size() == 2 ? sides[1 - i].facet : FacetId();
      REQUIRE(mesh.across(sides[i].facet, sides[i].edge) == expected);
    }
  }
  CHECK(t.vertices == graph.size());
  CHECK(t.unreferenced_vertices == mesh.num_vertices() - graph.size());
  CHECK(t.edges == edges.size());
  CHECK(t.facets == mesh.num_facets());
  CHECK(t.boundary_edges == boundary);
  CHECK(t.nonmanifold_edges == nonmanifold);
  CHECK(t.misoriented_edges == misoriented);
  CHECK(t.components == count_parts(graph));
  CHECK(t.boundary_loops == count_parts(boundary_graph));
  CHECK(t.euler == long(graph.size()) - long(edges.size()) + long(mesh.num_facets()));
  std::size_t bad = 0;
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    bad += !link_is_manifold(mesh, v);
  CHECK(t.nonmanifold_vertices == bad);
}

}  // namespace

TEST_CASE("trimesh: adjacency and topology follow from the definitions") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    check_against_definitions(mesh);
    CHECK(topology(mesh).manifold());
    CHECK(topology(mesh).misoriented_edges == 0);
  }
  check_against_definitions(torus(4));
  check_against_definitions(TriMesh());
  geom::Rng rng(3);
  for (int round = 0; round < 300; ++round) {  // few vertices: every kind of defect occurs
    const std::uint64_t n = 4 + rng.below(6);
    std::vector<std::array<int, 3>> triangles(1 + rng.below(10));
    for (auto& [a, b, c] : triangles) do {
        a = int(rng.below(n)), b = int(rng.below(n)), c = int(rng.below(n));
      } while (a == b || b == c || c == a);
    CAPTURE(round);
    check_against_definitions(connections(n, triangles));
  }
}

TEST_CASE("trimesh: known surfaces") {
  CHECK(topology(fixtures::box(Vec3(1, 2, 3), 3)).euler == 2);
  CHECK(topology(torus(5)).euler == 0);
  const Topology square = topology(fixtures::tilted_square(3));
  CHECK(square.euler == 1);
  CHECK(square.boundary_loops == 1);
  CHECK(square.boundary_edges == 12);
  CHECK(topology(fixtures::three_components()).components == 3);

  const Topology flipped = topology(connections(4, {{0, 1, 2}, {0, 1, 3}}));
  CHECK(flipped.misoriented_edges == 1);
  CHECK(flipped.manifold());
  const Topology book = topology(connections(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  CHECK(book.nonmanifold_edges == 1);
  CHECK(book.nonmanifold_vertices == 2);
  const Topology bow = topology(connections(6, {{0, 1, 2}, {0, 3, 4}}));
  CHECK(bow.nonmanifold_vertices == 1);
  CHECK(bow.nonmanifold_edges == 0);
  CHECK(bow.unreferenced_vertices == 1);
  CHECK(bow.components == 1);
  const TriMesh moebius = connections(5, {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 0}, {4, 0, 1}});
  CHECK(topology(moebius).euler == 0);
  CHECK(topology(moebius).boundary_loops == 1);
  CHECK(topology(moebius).misoriented_edges == 1);
}

TEST_CASE("trimesh: areas, normals, box") {
  const TriMesh box = fixtures::box(Vec3(1, 2, 3), 4);
  CHECK(box.area() == doctest::Approx(22));
  CHECK(box.diagonal() == doctest::Approx(std::sqrt(14.0)));
  double volume = 0;
  Vec3 sum(0, 0, 0);
  for (FacetId t(0); t.index() < box.num_facets(); t = FacetId(t.value + 1)) {
    volume += box.normal(t).dot(box.corner(t, 0)) / 6;
    sum += box.normal(t);
  }
  CHECK(volume == doctest::Approx(6));  // outward
  CHECK(sum.norm() < 1e-12);            // closed
  const TriMesh stray({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(9, 9, 9)},
                      {{VertexId(0), VertexId(1), VertexId(2)}});
  CHECK(stray.box().max() == Vec3(1, 1, 0));  // of what the facets use
  CHECK(TriMesh().diagonal() == 0);
}

TEST_CASE("trimesh: with vertices elsewhere it is the one made of them anew") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    Table<VertexId, Vec3> moved = mesh.vertices();
    for (Vec3& v : moved) v = Vec3(2 * v.y(), 1 - v.x(), v.z() / 3);
    const TriMesh found = mesh.with_vertices(moved), anew(moved, mesh.facets());
    CHECK(found.facets() == anew.facets());
    CHECK(&found.facets() == &mesh.facets());  // they are shared, as all is by a copy
    const TriMesh copy = found;
    CHECK(&copy.vertices() == &found.vertices());
    CHECK(found.box().min() == anew.box().min());
    CHECK(found.box().max() == anew.box().max());
    std::size_t different = 0;
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      for (int e = 0; e < 3; ++e) different += found.across(t, e) != anew.across(t, e);
    for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
      different += found.position(v) != moved[v];
    CHECK(different == 0);
  }
  const TriMesh triangle({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                         {{VertexId(0), VertexId(1), VertexId(2)}});
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(triangle.with_vertices({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, infinite, 0)}),
                  geom::InputError);
}

TEST_CASE("trimesh: bad arrays are refused") {
  const Table<VertexId, Vec3> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto make = [&](int a, int b, int c) {
    return TriMesh(corners, {{VertexId(a), VertexId(b), VertexId(c)}});
  };
  CHECK_NOTHROW(make(0, 1, 2));
  CHECK_THROWS_AS(make(0, 1, 3), geom::InputError);
  CHECK_THROWS_AS(make(0, 1, -1), geom::InputError);
  CHECK_THROWS_AS(make(0, 1, 1), geom::InputError);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(TriMesh({Vec3(0, bad, 0)}, {}), geom::InputError);
}

TEST_CASE("trimesh: the paper's models are what their description says") {
  struct Known {
    std::string file;
    std::size_t vertices, facets;
    long euler;
    std::size_t boundary_edges;
  };
  for (const Known& k : {Known{"eight.obj", 766, 1536, -2, 0}, Known{"elephant.obj", 2775, 5558, -4, 0},
                         Known{"joint.obj", 221, 446, -2, 0}, Known{"mask.obj", 31762, 62467, 1, 1055}}) {
    const auto path = fixtures::model(k.file);
    if (!path) return;
    CAPTURE(k.file);
    const Topology t = topology(io::read_mesh(*path));
    CHECK(t.vertices == k.vertices);
    CHECK(t.facets == k.facets);
    CHECK(t.euler == k.euler);
    CHECK(t.boundary_edges == k.boundary_edges);
    CHECK(t.components == 1);
    CHECK(t.manifold());
  }
}
