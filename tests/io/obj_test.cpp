#include "io/obj.h"

#include "doctest.h"
#include "tests/io/sample_meshes.h"

using fixtures::complaint;
using fixtures::corners;

namespace {

geom::TriMesh parse(std::string text) { return io::parse_obj({"a.obj", std::move(text)}); }

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: the four corner forms and negative indices name the same facet") {
  for (const std::string facet :
       {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//1 3//1", "f 1/9/1 2/8/1 3/7/1", "f -4 -3 -2",
        "f -4/-1 -3/-1 -2/-1", "f 1/ 2/ 3/", "fo 1 2 3", "  f\t1  2\t3  "}) {
    CAPTURE(facet);
    CHECK(corners(parse(square + facet + "\n")) == "0 1 2");
    CHECK(corners(parse(square + facet)) == "0 1 2");
  }
}

TEST_CASE("OBJ: normals and texture coordinates never split a vertex") {
  const auto mesh =
      parse(square + "vt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\nf 1/1/1 2/1/1 3/1/1\nf 1/2/2 3/2/2 4/2/2\n");
  CHECK(mesh.num_vertices() == 4);
  CHECK(corners(mesh) == "0 1 2, 0 2 3");
}

TEST_CASE("OBJ: polygons are triangulated, also those that are not convex") {
  CHECK(parse(square + "f 1 2 3 4\n").num_facets() == 2);
  // An arrow head whose fan from vertex 0 would leave the polygon.
  const auto arrow = parse("v 0 0 0\nv 2 2 0\nv 0 1 0\nv -2 2 0\nf 2 3 4 1\n");
  REQUIRE(arrow.num_facets() == 2);
  CHECK(arrow.normal(geom::FacetId(0)).z() * arrow.normal(geom::FacetId(1)).z() > 0);
  const auto dart = parse("v 2 2 0\nv 0 1 0\nv -2 2 0\nv 0 0 0\nf 1 2 3 4\n");
  REQUIRE(dart.num_facets() == 2);
  CHECK(dart.normal(geom::FacetId(0)).z() * dart.normal(geom::FacetId(1)).z() > 0);
}

TEST_CASE("OBJ: comments, continued lines, colours, w, unknown statements, later vertices, line ends") {
  const std::string text =
      "# C:\\models\\\n"
      "mtllib some\\where.mtl\n"
      "o thing\n"
      "v 0 0 0 1.0\n"
      "v 1 0 \\\n 0 0.5 0.5 0.5 # red, green, blue\n"
      "vp 0.5\n"
      "p 1\nl 1 2\n"
      "f 1 2 \\\n"
      "  3 \\\n"
      "  4\n"
      "usemtl none\ns off\n"
      "v +1 1e0 0.\n"
      "v 0 1 0";
  const auto mesh = parse(text);
  CHECK(mesh.num_vertices() == 4);
  CHECK(mesh.num_facets() == 2);
  CHECK(mesh.position(geom::VertexId(2)) == geom::Vec3(1, 1, 0));
  for (const std::string line_end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? line_end : std::string(1, c);
    CHECK(fixtures::identical(parse(other), mesh));
  }
  CHECK(fixtures::identical(parse("\xEF\xBB\xBF" + text), mesh));
}

TEST_CASE("OBJ: each fault is named with its line") {
  const auto fault = [](const std::string& text) { return complaint([&] { parse(text); }); };
  CHECK(fault(square + "f 1 2 9\n") == "a.obj:5: vertex index 9 out of range (the file has 4 vertices)");
  CHECK(fault(square + "\nf 1 2 -5\n") == "a.obj:6: vertex index -5 out of range (4 vertices so far)");
  CHECK(fault(square + "f 0 1 2\n") == "a.obj:5: vertex index 0 (the first vertex is 1)");
  CHECK(fault(square + "f 1 2\n") == "a.obj:5: a facet needs three corners");
  CHECK(fault(square + "f 1 2 x\n") == "a.obj:5: vertex index 'x' is not a whole number");
  CHECK(fault(square + "f 1 2 3.5\n") == "a.obj:5: vertex index '3.5' is not a whole number");
  CHECK(fault(square + "f 1 2 3/a\n") == "a.obj:5: '3/a' is not a facet corner");
  CHECK(fault(square + "f 1 2 2\n") == "a.obj:5: a facet names vertex 2 twice");
  CHECK(fault(square + "f 1 2 3 4 2\n") == "a.obj:5: a facet names vertex 2 twice");
  CHECK(fault(square + "f 1 2 99999999999999999999\n").starts_with("a.obj:5: vertex index "));
  CHECK(fault("v 0 0\n") == "a.obj:1: a coordinate is missing");
  CHECK(fault("v 0 0 1,5\n") == "a.obj:1: '1,5' is not a number");
  CHECK(fault("v 0 0 nan\n") == "a.obj:1: a coordinate is not a number (NaN)");
  CHECK(fault("v 0 0 -inf\n").starts_with("a.obj:1: a coordinate is infinite"));
  CHECK(fault("v 0 0 1e999\n").starts_with("a.obj:1: a coordinate is infinite"));
  CHECK(fault("v 0 0 1.1e48\n").starts_with("a.obj:1: a coordinate is beyond 1e48"));
  CHECK(fault(square) == "a.obj: no facets");
  CHECK(fault("\n\n# nothing\n") == "a.obj: no facets");
  CHECK(fault("v 1 \\\n 2 \\\n \x01z\n") == "a.obj:3: '?z' is not a number");
}

TEST_CASE("OBJ: numbers too small for a double are zero") {
  CHECK(parse("v 1e-400 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").position(geom::VertexId(0)).x() == 0);
}
