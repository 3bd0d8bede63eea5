#include "geom/mesh/surface_type.h"

#include <string>

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

using geom::PartType;
using geom::TriMesh;

TEST_CASE("surface type: that of each shape, part by part") {
  for (const geom::ShapeInfo& info : geom::shape_table()) {
    CAPTURE(std::string(info.name));
    const geom::SurfaceType type =
        geom::surface_type(geom::make_shape(info.name, info.name == "double-torus" ? 31 : 3));
    CHECK(type.manifold);
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

TEST_CASE("surface type: bodies that share a vertex are two parts, with an edge they are one") {
  const TriMesh two = geom::joined(geom::make_shape("cube"), geom::make_shape("cube"));
  const auto with_shared = [&](int count) {
    auto facets = two.facets();
    for (TriMesh::Facet& f : facets)
      for (geom::VertexId& v : f)
        if (v.index() >= 8 && v.index() < 8 + static_cast<std::size_t>(count))
          v = geom::VertexId(v.index() - 8);
    return geom::surface_type(TriMesh(two.vertices(), facets));
  };
  CHECK(with_shared(0).manifold);
  CHECK(!with_shared(1).manifold);
  CHECK(with_shared(1).parts == std::vector<PartType>{{2, 0, true}, {2, 0, true}});
  CHECK(with_shared(2).parts.size() == 1);  // vertices 0 and 1 end an edge
}
