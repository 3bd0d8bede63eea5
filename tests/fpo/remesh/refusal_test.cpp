#include "fpo/remesh/refusal.h"

#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::TriMesh;

TEST_CASE("refusal: a remnant is told with the number that would do, if one is known that is larger") {
  const TriMesh cube = geom::make_shape("cube");
  CHECK_NOTHROW(refuse_remnant(cube));
  geom::Table<geom::VertexId, geom::Vec3> vertices = cube.vertices();
  for (int i = 0; i < 3; ++i) vertices.push_back({2, 2, 2});
  const TriMesh remnant(vertices, cube.facets());
  CHECK(is_remnant(remnant));
  const std::string words =
      "the surface is thinner than the spacing of 11 samples: only 8 of them have a triangle";
  for (const std::size_t enough : {0u, 11u})
    CHECK_THROWS_WITH_AS(refuse_remnant(remnant, enough), words.c_str(), geom::InputError);
  CHECK_THROWS_WITH_AS(refuse_remnant(remnant, 40), (words + "; about 40 would do").c_str(),
                       geom::InputError);
}
