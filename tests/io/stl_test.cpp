#include "io/stl.h"

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/io/sample_meshes.h"

using fixtures::complaint;
using fixtures::corners;

namespace {

geom::TriMesh parse_stl(std::string bytes) { return io::parse_stl({"a.stl", std::move(bytes)}); }

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return " facet normal 0 0 1\n  outer loop\n   vertex " + a + "\n   vertex " + b + "\n   vertex " + c +
         "\n  endloop\n endfacet\n";
}

const std::string one = facet("0 0 0", "1 0 0", "0 1 0");

}  // namespace

TEST_CASE("STL text: vertices are welded by equal coordinates, -0 equals 0") {
  const auto mesh =
      parse_stl("solid two\n" + one + facet("0 1 -0.0", "1.0 -0 0", "1 1e0 0") + "endsolid two\n");
  CHECK(mesh.num_vertices() == 4);
  CHECK(corners(mesh) == "0 1 2, 2 1 3");
  CHECK(parse_stl("solid\n" + one + facet("0 1e-300 0", "1 0 0", "1 1 0") + "endsolid\n").num_vertices() ==
        5);
}

TEST_CASE("STL text: several solids, any case, names, odd normals, line ends") {
  const std::string text =
      "solid first part\n" + one + "endsolid first part\n\nSOLID\nFACET NORMAL nan -nan(ind) inf\n" +
      "OUTER LOOP\nVERTEX 0 0 5\nVERTEX 1 0 5\nVERTEX 0 1 5\nENDLOOP\nENDFACET\nENDSOLID";
  CHECK(corners(parse_stl(text)) == "0 1 2, 3 4 5");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(fixtures::identical(parse_stl(windows), parse_stl(text)));
}

TEST_CASE("STL: facets with a repeated corner are dropped") {
  const auto mesh = parse_stl("solid\n" + facet("0 0 0", "0 0 0", "1 0 0") + one + "endsolid\n");
  CHECK(corners(mesh) == "0 1 2");
}

TEST_CASE("STL binary: told by count and size, whatever the header says; large ones weld as well") {
  std::string bytes = io::to_stl(fixtures::tetrahedron());
  CHECK(bytes.size() == 84 + 4 * 50);
  bytes.replace(0, 10, "solid cube");
  const auto mesh = parse_stl(bytes);
  CHECK(mesh.num_vertices() == 4);
  CHECK(fixtures::same_soup(mesh, fixtures::tetrahedron()));

  std::vector<geom::Vec3> points;
  std::vector<fixtures::Facet> facets;
  constexpr int n = 60;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      points.emplace_back(x, y, 0);
      const int v = y * n + x;
      if (x > 0 && y > 0) facets.insert(facets.end(), {{v - n - 1, v - n, v}, {v - n - 1, v, v - 1}});
    }
  const auto grid = parse_stl(io::to_stl(fixtures::make_mesh(points, facets)));
  CHECK(grid.num_vertices() == n * n);
  CHECK(grid.num_facets() == facets.size());
}

TEST_CASE("STL: each fault is named with its place") {
  const auto fault = [](const std::string& bytes) { return complaint([&] { parse_stl(bytes); }); };
  const std::string binary = io::to_stl(fixtures::tetrahedron());
  CHECK(fault(binary.substr(0, 200)) ==
        "a.stl:byte 80: truncated: the header promises 4 facets of 50 bytes, 116 bytes follow");
  CHECK(fault(binary + "x") == "a.stl:byte 80: the header promises 4 facets of 50 bytes, 201 bytes follow");
  CHECK(fault(std::string(80, ' ') + "\xff\xff\xff\xff").starts_with("a.stl:byte 80: truncated: "));
  CHECK(fault(std::string(84, '\0')) == "a.stl: no facets");
  CHECK(fault("neither") == "a.stl: truncated: neither a text STL nor 84 bytes of binary header");
  std::string nan = binary;
  nan.replace(84 + 50 + 12, 4, "\xff\xff\xff\xff");
  CHECK(fault(nan) == "a.stl:byte 134: a coordinate is not a number (NaN)");
  std::string solid = binary.substr(0, 200);
  solid.replace(0, 5, "solid");
  CHECK(fault(solid).starts_with("a.stl:byte 80: truncated: "));

  CHECK(fault("solid\n" + one) == "a.stl:9: truncated: the file ends before 'endsolid'");
  CHECK(fault("solid\n" + one.substr(0, one.size() - 10)) ==
        "a.stl:8: truncated: the file ends where 'endfacet' should follow");
  CHECK(fault("solid\n" + one.substr(0, 60)).find("a.stl:5: ") == 0);
  CHECK(fault("solid\nendsolid\n") == "a.stl: no facets");
  CHECK(fault("solid\n" + facet("0 0 0", "0 0 0", "1 0 0") + "endsolid\n") == "a.stl: no facets");
  CHECK(fault("solid\n" + facet("0 0 0", "1 0 x", "0 1 0") + "endsolid\n") == "a.stl:5: 'x' is not a number");
  CHECK(fault("solid\n" + facet("0 0 0", "1 0", "0 1 0") + "endsolid\n") ==
        "a.stl:5: a coordinate is missing");
  CHECK(fault("solid\n" + facet("0 0 0", "1 0 1e70", "0 1 0") + "endsolid\n")
            .starts_with("a.stl:5: a coordinate is beyond"));
  CHECK(fault("solid\nvertex 0 0 0\nendsolid\n") ==
        "a.stl:2: 'vertex' where 'facet' or 'endsolid' should follow");
  CHECK(fault("solid\n" + one + "endsolid\nnonsense\n") ==
        "a.stl:10: 'nonsense' where 'solid' should follow");
}

TEST_CASE("STL: coordinates beyond single precision cannot be written") {
  const auto mesh = fixtures::make_mesh({{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  CHECK(complaint([&] { io::to_stl(mesh); }) == "a coordinate is beyond STL's single precision");
  const auto tiny = fixtures::make_mesh({{0, 0, 0}, {1e-31, 0, 0}, {0, 1e-31, 0}}, {{0, 1, 2}});
  CHECK(complaint([&] { io::to_stl(tiny); }) == "the coordinates are too small for STL's single precision");
}

TEST_CASE("STL: what single precision would ruin cannot be written") {
  const geom::TriMesh sphere = geom::make_shape("sphere", 8);
  const std::string refusal =
      "STL's single precision is too coarse for edges that short so far from the origin";
  for (const auto& [far, holds] :
       {std::pair(0.0, true), std::pair(1e3, true), std::pair(1e6, false), std::pair(1e8, false)}) {
    CAPTURE(far);
    const geom::TriMesh moved =
        geom::mapped(sphere, [&](const geom::Vec3& p) -> geom::Vec3 { return p + geom::Vec3(far, 0, 0); });
    const double edge = 0.2;  // about
    if (holds) {
      CHECK(parse_stl(io::to_stl(moved)).num_vertices() == sphere.num_vertices());
      CHECK_NOTHROW(io::require_stl_edges(moved, edge));
    } else {
      CHECK(complaint([&] { io::to_stl(moved); }) == refusal);
      CHECK(complaint([&] { io::require_stl_edges(moved, edge); }) == refusal);
    }
  }
}
