#include "io/off.h"

#include "doctest.h"
#include "tests/io/sample_meshes.h"

using fixtures::complaint;
using fixtures::corners;

namespace {

geom::TriMesh parse_off(std::string text) { return io::parse_off({"a.off", std::move(text)}); }

const std::string off_square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("OFF: counts on the same or the next line, with or without edges, comments, blank lines") {
  const std::string facets = "3 0 1 2\n3 0 2 3\n";
  for (const std::string header :
       {"OFF\n4 2 0\n", "OFF 4 2 0\n", "OFF\n4 2\n", "OFF4 2 0\n", "\t NOFF4 2 # or so\n",
        "# made by hand\nOFF # text\n\n# counts\n4 2 5\n\n", "OFF\r\n4 2 0\r\n",
        "\xEF\xBB\xBFOFF\n4 2 0\n"}) {
    CAPTURE(header);
    CHECK(corners(parse_off(header + off_square + "\n# facets\n" + facets)) == "0 1 2, 0 2 3");
  }
}

TEST_CASE("OFF: what follows the coordinates or the corners is ignored") {
  const auto mesh = parse_off(
      "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 255 0 255\n0 1 0 0 0 255 255\n3 0 1 2 0.1 0.2 0.3\n");
  CHECK(corners(mesh) == "0 1 2");
  CHECK(corners(parse_off("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 2 1 0 17\n")) == "2 1 0");
  CHECK(corners(parse_off("STCNOFF 3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 2 1 0\n")) == "2 1 0");
}

TEST_CASE("OFF: polygons are triangulated, points and lines ignored, the last line end may miss") {
  const auto mesh = parse_off("OFF\n4 3 0\n" + off_square + "1 0\n2 0 1\n4 0 1 2 3");
  CHECK(mesh.num_facets() == 2);
  CHECK(mesh.area() == 1);
}

TEST_CASE("OFF: a facet goes on in the next lines, and still the next one begins a line") {
  const auto mesh = parse_off("OFF\n4 2 0\n" + off_square + "3\n\n 0 1 # two\n\t2 255 0 0\n3 0\n2\n3\n\n");
  CHECK(corners(mesh) == "0 1 2, 0 2 3");
  CHECK(parse_off("OFF\n4 2 0\n" + off_square + "4 0\n1\n2\n3\n2\n0\n1").num_facets() == 2);
}

TEST_CASE("OFF: a corner that was forgotten is found out, and where") {
  const auto fault = [](const std::string& facets) {
    return complaint([&] { parse_off("OFF\n4 2 0\n" + off_square + facets); });
  };
  CHECK(fault("3 0 1\n3 0 2 3\n") ==
        "a.off:9: truncated: the file ends before facet 2 of 2, and the one of "
        "line 7 goes on in line 8");
  CHECK(fault("3 0 1\n9 0 2 3\n3 0 1 2") == "a.off:7: vertex index 9 out of range (the file has 4 vertices)");
  CHECK(fault("3 0 1 2\n3 0\n2\n-3\n") == "a.off:8: vertex index -3 out of range (the first vertex is 0)");
  CHECK(fault("3 0 1 2\n3 0\n2\nx\n") == "a.off:10: vertex index 'x' is not a whole number");
  CHECK(fault("3\n0 1\n1\n3 0 2 3\n") == "a.off:7: a facet names vertex 1 twice");
  CHECK(fault("3 0 1 2\n3 0\n\n2\n\n") ==
        "a.off:8: truncated: the file ends inside the facet that begins here");
}

TEST_CASE("OFF: each fault is named with its line") {
  const auto fault = [](const std::string& text) { return complaint([&] { parse_off(text); }); };
  CHECK(fault("4 2 0\n" + off_square) == "a.off:1: no OFF header (OFF, COFF, NOFF, ...)");
  CHECK(fault("\n\n").find("no OFF header") != std::string::npos);
  for (const std::string header : {"4OFF 1 1 1\n", "OFFS 4 2 0\n", "OFF-4 2 0\n", "ST4 2 0\n"})
    CHECK(fault(header + off_square).find("no OFF header") != std::string::npos);
  CHECK(fault("OFF\n") == "a.off:2: truncated: the file ends before the counts");
  CHECK(fault("OFF\n4\n" + off_square) == "a.off:2: the number of facets is missing");
  CHECK(fault("OFF\n4 -1 0\n" + off_square) == "a.off:2: the number of facets is negative");
  CHECK(fault("OFF\n4 x 0\n" + off_square) == "a.off:2: the number of facets 'x' is not a whole number");
  CHECK(fault("OFF\n4000000000000000000 1 0\n" + off_square) ==
        "a.off:2: truncated: the header promises 4000000000000000000 vertices and 1 facets, only 27 bytes "
        "follow");
  CHECK(fault("OFF\n4 999999999 0\n" + off_square).starts_with("a.off:2: truncated: "));
  CHECK(fault("OFF\n4 1 0\n" + off_square + "3 0 1 4\n") ==
        "a.off:7: vertex index 4 out of range (the file has 4 vertices)");
  CHECK(fault("OFF\n4 1 0\n" + off_square + "3 0 1 -1\n") ==
        "a.off:7: vertex index -1 out of range (the first vertex is 0)");
  CHECK(fault("OFF\n4 1 0\n" + off_square + "3 0 1\n") ==
        "a.off:7: truncated: the file ends inside the facet that begins here");
  CHECK(fault("OFF\n4 1 0\n" + off_square + "3 0 1 1\n") == "a.off:7: a facet names vertex 1 twice");
  CHECK(fault("OFF\n4 1 0\n" + off_square + "99999999 0 1 1\n") ==
        "a.off:7: truncated: a facet of 99999999 corners");
  CHECK(fault("OFF\n4 2 0\n" + off_square + "3 0 1 2\n") ==
        "a.off:8: truncated: the file ends before facet 2 of 2");
  CHECK(fault("OFF\n3 1 0\n" + off_square + "3 0 1 2\n") == "a.off:7: more lines than the header announces");
  CHECK(fault("OFF\n4 1 0\n" + off_square + "3 0 1 2\n3 0 2 3\n") ==
        "a.off:8: more lines than the header announces");
  CHECK(fault("OFF\n4 1 0\n0 0 nan\n" + off_square).starts_with("a.off:3: a coordinate is not a number"));
  CHECK(fault("OFF\n4 0 0\n" + off_square) == "a.off: no facets");
}
