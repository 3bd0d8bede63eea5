#include "geom/mesh/surface_type.h"

#include <algorithm>
#include <string>

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/book.h"

using geom::PartType;
using geom::TriMesh;

TEST_CASE("surface type: that of each shape, part by part") {
  for (const geom::ShapeInfo& info : geom::shape_table()) {
    CAPTURE(std::string(info.name));
    const geom::SurfaceType type =
        geom::surface_type(geom::make_shape(info.name, info.name == "double-torus" ? 31 : 3));
    CHECK(!type.branches);
    CHECK(type.split_vertices == 0);
    REQUIRE(type.parts.size() == info.components);
    for (const PartType& part : type.parts)
      CHECK(part ==
            PartType{info.euler / static_cast<long>(info.components), info.boundary_loops, info.orientable});
  }
}

TEST_CASE("surface type: parts are in the order of their first facets") {
  const TriMesh mesh =
      geom::joined(geom::joined(geom::make_shape("torus", 6), geom::make_shape("moebius", 9)),
                   geom::make_shape("tube", 5));
  const geom::SurfaceType type = geom::surface_type(mesh);
  CHECK(type.parts == std::vector<PartType>{{0, 0, true}, {0, 1, false}, {0, 2, true}});
  for (std::size_t t = 1; t < mesh.num_facets(); ++t)
    CHECK(type.part_of[geom::FacetId(t - 1)] <= type.part_of[geom::FacetId(t)]);
}

namespace {

/// With vertices of the mesh that are one and the same.
TriMesh with_merged(const TriMesh& mesh, const std::vector<std::pair<int, int>>& pairs) {
  auto facets = mesh.facets();
  for (TriMesh::Facet& f : facets)
    for (geom::VertexId& v : f)
      for (const auto& [to, from] : pairs)
        if (v == geom::VertexId(from)) v = geom::VertexId(to);
  return TriMesh(mesh.vertices(), facets);
}

}  // namespace

TEST_CASE("surface type: bodies that share a vertex are two parts, with an edge they are one") {
  const TriMesh two = geom::joined(geom::make_shape("cube"), geom::make_shape("cube"));
  const geom::SurfaceType at_a_vertex = geom::surface_type(with_merged(two, {{0, 8}}));
  CHECK(!at_a_vertex.branches);
  CHECK(at_a_vertex.split_vertices == 1);
  CHECK(at_a_vertex.parts == std::vector<PartType>{{2, 0, true}, {2, 0, true}});
  CHECK(at_a_vertex.whole() == PartType{4, 0, true});
  const geom::SurfaceType at_an_edge = geom::surface_type(with_merged(two, {{0, 8}, {1, 9}}));
  CHECK(at_an_edge.branches);
  CHECK(at_an_edge.parts.size() == 1);  // vertices 0 and 1 end an edge
}

TEST_CASE("surface type: a part that meets itself in vertices is of the type it has when these are split") {
  // Whatever vertices without a common neighbour are merged, splitting them gives the shape back.
  const TriMesh torus = geom::make_shape("torus", 24), tube = geom::make_shape("tube", 12);
  const geom::SurfaceType pinched = geom::surface_type(with_merged(torus, {{0, 30}, {0, 61}, {5, 100}}));
  REQUIRE(geom::topology(with_merged(torus, {{0, 30}, {0, 61}, {5, 100}})).euler == -3);
  CHECK(pinched.parts == std::vector<PartType>{{0, 0, true}});
  CHECK(pinched.split_vertices == 2);

  // Vertices of the border, of one loop and of two, and one of the border with one inside.
  std::vector<int> border, inner;
  for (std::size_t v = 0; v < tube.num_vertices(); ++v) border.push_back(0);
  for (std::size_t t = 0; t < tube.num_facets(); ++t)
    for (int e = 0; e < 3; ++e)
      if (!tube.across(geom::FacetId(t), e).valid())
        for (const int i : {e, (e + 1) % 3})
          border[tube.facet(geom::FacetId(t))[static_cast<std::size_t>(i)].index()] = 1;
  for (std::size_t v = 0; v < tube.num_vertices(); ++v)
    if (!border[v]) inner.push_back(static_cast<int>(v));
  std::vector<int> rim;
  for (std::size_t v = 0; v < tube.num_vertices(); ++v)
    if (border[v]) rim.push_back(static_cast<int>(v));
  for (const auto& [a, b] : {std::pair{rim.front(), rim[rim.size() / 4]}, std::pair{rim.front(), rim.back()},
                             std::pair{rim.front(), inner[inner.size() / 2]}}) {
    CAPTURE(a);
    CAPTURE(b);
    const TriMesh merged = with_merged(tube, {{a, b}});
    REQUIRE(geom::topology(merged).nonmanifold_vertices == 1);
    CHECK(geom::surface_type(merged).parts == std::vector<PartType>{{0, 2, true}});
  }
}

TEST_CASE(
    "surface type: the pieces between edges of more than two facets are those of the surface cut there") {
  for (const int pages : {3, 4, 9}) {
    const std::vector<geom::PartType> pieces = geom::pieces_between_branches(fixtures::book(pages));
    CHECK(pieces == std::vector<geom::PartType>(static_cast<std::size_t>(pages), {1, 1, true}));
  }
  for (const char* name : {"torus", "moebius", "two-spheres", "tube"}) {
    const geom::TriMesh mesh = geom::make_shape(name, 6);
    std::vector<geom::PartType> parts = geom::surface_type(mesh).parts;
    std::ranges::sort(parts);
    CHECK(geom::pieces_between_branches(mesh) == parts);
  }
  // Bodies that share an edge: each is a slit sphere, of however many edges the slit is.
  const TriMesh two = geom::joined(geom::make_shape("cube"), geom::make_shape("cube"));
  const TriMesh bodies = with_merged(two, {{0, 8}, {1, 9}});
  REQUIRE(geom::topology(bodies).nonmanifold_edges == 1);
  const std::vector<geom::PartType> slit(2, {1, 1, true});
  CHECK(geom::pieces_between_branches(bodies) == slit);
  CHECK(geom::pieces_between_branches(geom::subdivided(bodies, 2)) == slit);
}
