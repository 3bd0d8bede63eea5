#include "fpo/remesh/type_check.h"

#include <cmath>

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/book.h"
#include "tests/fixtures/pinched.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

/// As if each vertex of the mesh were a sample in a facet of it.
std::vector<SurfaceSample> samples_at_vertices(const TriMesh& mesh) {
  std::vector<SurfaceSample> samples(mesh.num_vertices());
  for (std::size_t t = 0; t < mesh.num_facets(); ++t)
    for (const VertexId v : mesh.facet(FacetId(t))) samples[v.index()] = {mesh.position(v), FacetId(t)};
  return samples;
}

TriMesh without_facets(const TriMesh& mesh, std::size_t from, std::size_t to) {
  geom::Table<FacetId, TriMesh::Facet> facets;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t)
    if (t < from || t >= to) facets.push_back(mesh.facet(FacetId(t)));
  return {mesh.vertices(), facets};
}

/// What is wrong with `remesh`, whose vertices are those of `mesh`.
TypeCheck check(const TriMesh& mesh, const TriMesh& remesh) {
  return check_type(geom::surface_type(mesh), remesh, samples_at_vertices(mesh));
}

}  // namespace

TEST_CASE("type check: a surface is of its own type") {
  for (const char* name : {"torus", "two-spheres", "moebius", "tube", "cube"}) {
    const TriMesh mesh = geom::make_shape(name, 4);
    CHECK(check(mesh, mesh).ok());
  }
}

TEST_CASE("type check: a part that is lost, a hole, a branching edge") {
  const TriMesh mesh = geom::joined(geom::make_shape("sphere", 2), geom::make_shape("torus", 5));
  const TypeCheck lost = check(mesh, without_facets(mesh, 0, 80));
  CHECK(!lost.ok());
  CHECK(lost.lost_parts == 1);
  CHECK(lost.parts == std::vector<std::size_t>{0});
  CHECK(lost.bare_samples == 42);
  const TypeCheck hole = check(mesh, without_facets(mesh, 85, 86));
  CHECK(hole.is_manifold());
  CHECK(hole.changed_parts == 1);
  CHECK(hole.parts == std::vector<std::size_t>{1});

  auto facets = mesh.facets();
  facets.push_back({facets[FacetId(0)][0], facets[FacetId(0)][1], facets[FacetId(40)][2]});
  const TypeCheck branching = check(mesh, TriMesh(mesh.vertices(), facets));
  CHECK(branching.nonmanifold_edges > 0);
  CHECK(!branching.ok());
}

TEST_CASE("type check: a triangle twice is no sphere, though its Euler number is that of one") {
  const TriMesh mesh = geom::make_shape("sphere", 1);
  const TriMesh::Facet f = mesh.facet(FacetId(3));
  const TypeCheck found =
      check_type(geom::surface_type(mesh),
                 TriMesh({mesh.position(f[0]), mesh.position(f[1]), mesh.position(f[2])},
                         {{VertexId(0), VertexId(1), VertexId(2)}, {VertexId(0), VertexId(2), VertexId(1)}}),
                 std::vector<SurfaceSample>(3, {mesh.position(f[0]), FacetId(3)}));
  CHECK(found.is_manifold());
  CHECK(found.changed_parts == 0);
  CHECK(found.doubled_facets == 2);
  CHECK(found.parts == std::vector<std::size_t>{0});
  CHECK(!found.ok());
}

TEST_CASE("type check: parts that are joined, that are two") {
  // A remesh of two spheres in which a facet of each is gone and a tube joins the holes.
  const TriMesh spheres = geom::make_shape("two-spheres", 1);
  auto facets = without_facets(spheres, 39, 40).facets();
  const TriMesh::Facet a = spheres.facet(FacetId(0)), b = spheres.facet(FacetId(39));
  geom::Table<FacetId, TriMesh::Facet> joined;
  for (std::size_t t = 1; t < facets.size(); ++t) joined.push_back(facets[FacetId(t)]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    joined.push_back({a[i], a[j], b[2 - j]});
    joined.push_back({a[i], b[2 - j], b[2 - i]});
  }
  const TypeCheck check_joined = check(spheres, TriMesh(spheres.vertices(), joined));
  CHECK(check_joined.joined_parts == 1);
  CHECK(check_joined.is_manifold());
  CHECK(check_joined.parts == std::vector<std::size_t>{0, 1});

  // And the other way round: the input is one part, the remesh two.
  const TriMesh dumbbell(spheres.vertices(), joined);
  const TypeCheck split = check(dumbbell, spheres);
  CHECK(split.split_parts == 1);
  CHECK(split.changed_parts == 0);
  CHECK(!split.ok());
}

TEST_CASE("type check: Euler numbers that agree in all but not part by part") {
  // One remesh lost the torus's handle, where it is a sphere, and gave the sphere one.
  const TriMesh input = geom::joined(geom::make_shape("torus", 5), geom::make_shape("sphere", 1));
  const TriMesh output = geom::joined(geom::make_shape("sphere", 1), geom::make_shape("torus", 5));
  std::vector<SurfaceSample> samples = samples_at_vertices(output);
  const std::size_t sphere_facet = input.num_facets() - 1;
  for (std::size_t v = 0; v < samples.size(); ++v) samples[v].facet = FacetId(v < 12 ? 0 : sphere_facet);
  const geom::Topology in = geom::topology(input), out = geom::topology(output);
  REQUIRE(in.euler == out.euler);
  REQUIRE(in.components == out.components);
  CHECK(check_type(geom::surface_type(input), output, samples).changed_parts == 2);
}

TEST_CASE("type check: of an input that meets itself in a vertex a remesh with that vertex split is right") {
  const TriMesh pinched = fixtures::pinched_sphere();
  auto vertices = pinched.vertices();
  auto facets = pinched.facets();
  vertices.push_back(vertices[VertexId(0)]);
  std::size_t below = 0;
  for (TriMesh::Facet& f : facets)
    for (VertexId& v : f)
      if (v == VertexId(0) && vertices[f[1]].z() + vertices[f[2]].z() < 0)
        v = VertexId(vertices.size() - 1), ++below;
  REQUIRE(below == 24);
  const TriMesh split(vertices, facets);
  const auto against_pinched = [&](const TriMesh& remesh) {
    return check_type(geom::surface_type(pinched), remesh, samples_at_vertices(remesh));
  };
  CHECK(against_pinched(split).ok());
  CHECK(!against_pinched(pinched).ok());  // itself is no manifold
  CHECK(against_pinched(pinched).same_parts());
  CHECK(against_pinched(without_facets(split, 100, 101)).changed_parts == 1);
}

TEST_CASE("type check: edges that are to branch are right with as many triangles, wrong with others") {
  const TriMesh mesh = fixtures::book(3);
  const auto with = [&](std::size_t facets) {
    const BranchEdges spine{{geom::mesh_edge(VertexId(0), VertexId(1)), facets}};
    return check_type({mesh, spine}, mesh, samples_at_vertices(mesh));
  };
  CHECK(with(3).ok());
  CHECK(!with(4).ok());
  CHECK(with(4).nonmanifold_edges == 1);
  CHECK(with(4).nonmanifold_vertices == 2);
  CHECK(!check(mesh, mesh).ok());
}

TEST_CASE(
    "type check: pages that are in pieces, or not at all of their spine, are told though they hang on") {
  // Three pages of two quadrangles along a spine of two edges; vertex i of each page is 3 page + i.
  const auto pages = [](const std::vector<std::array<int, 3>>& last) {
    geom::Table<VertexId, geom::Vec3> vertices;
    for (int i = 0; i < 12; ++i)
      vertices.push_back(geom::Vec3(std::cos(2.0 * (i / 3)), std::sin(2.0 * (i / 3)), i % 3) -
                         (i < 3 ? geom::Vec3(1, 0, 0) : geom::Vec3(0, 0, 0)));
    geom::Table<FacetId, TriMesh::Facet> facets;
    const auto add = [&](int a, int b, int c) { facets.push_back({VertexId(a), VertexId(b), VertexId(c)}); };
    for (const int p : {3, 6}) add(0, 1, p + 1), add(0, p + 1, p), add(1, 2, p + 2), add(1, p + 2, p + 1);
    for (const auto& [a, b, c] : last) add(a, b, c);
    return TriMesh(std::move(vertices), std::move(facets));
  };
  const TriMesh whole = pages({{0, 1, 10}, {0, 10, 9}, {1, 2, 11}, {1, 11, 10}});
  const WantedType wanted(whole, {{geom::mesh_edge(VertexId(0), VertexId(1)), 3},
                                  {geom::mesh_edge(VertexId(1), VertexId(2)), 3}});
  const auto check_of = [&](const TriMesh& remesh) {
    return check_type(wanted, remesh, samples_at_vertices(whole));
  };
  CHECK(check_of(whole).ok());
  const TypeCheck teeth = check_of(pages({{0, 1, 10}, {0, 10, 9}, {1, 2, 11}}));
  CHECK(teeth.is_manifold());
  CHECK(teeth.same_parts());
  CHECK(teeth.new_pieces == 1);
  CHECK(!teeth.ok());
  const TypeCheck loose = check_of(pages({{0, 1, 10}, {0, 10, 9}, {1, 11, 10}}));  // at (1, 2) there are two
  CHECK(loose.nonmanifold_edges == 1);
  CHECK(!loose.ok());
}
