#include "io/binary_off.h"

#include <cmath>
#include <limits>

#include "doctest.h"
#include "io/off.h"
#include "tests/io/binary_off_samples.h"
#include "tests/io/sample_meshes.h"

using fixtures::binary_off;
using fixtures::BinaryOff;
using fixtures::complaint;
using fixtures::corners;

namespace {

constexpr BinaryOff::Layout geomview{std::endian::big, true};
constexpr BinaryOff::Layout without_colours{std::endian::little, false};
constexpr BinaryOff::Layout binary_layouts[] = {geomview, {std::endian::little, true}, without_colours};

geom::TriMesh parse_bytes(std::string bytes) { return io::parse_off({"a.off", std::move(bytes)}); }

std::string fault_of(const std::string& bytes) {
  return complaint([&] { parse_bytes(bytes); });
}

/// A square's corners, and facets to come.
BinaryOff binary_square(BinaryOff::Layout layout, std::size_t num_facets) {
  BinaryOff file(layout);
  file.add_counts(4, num_facets);
  for (const std::vector<double>& p : {std::vector<double>{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
    file.add_vertex(p);
  return file;
}

}  // namespace

TEST_CASE("OFF binary: in every layout the mesh that the text has") {
  for (const BinaryOff::Layout layout : binary_layouts)
    for (const geom::TriMesh& mesh : {fixtures::tetrahedron(), fixtures::random_soup(7, true)}) {
      const geom::TriMesh binary = parse_bytes(binary_off(mesh, layout));
      CHECK(fixtures::identical(binary, mesh));
      CHECK(fixtures::identical(binary, parse_bytes(io::to_off(mesh))));
    }
}

TEST_CASE("OFF binary: ends of the header line, comments before and in it") {
  const std::string body = binary_off(fixtures::tetrahedron(), without_colours).substr(11);
  for (const std::string header :
       {"OFF BINARY\n", "OFF  BINARY \r\n", "# by hand\n\nOFF BINARY # from here\n"})
    CHECK(fixtures::identical(parse_bytes(header + body), fixtures::tetrahedron()));
}

TEST_CASE("OFF binary: counts that begin with a line end's code") {
  BinaryOff file(without_colours);
  file.add_counts(10, 13);
  for (int i = 0; i < 10; ++i) file.add_vertex({std::cos(i), std::sin(i), 0});
  for (int i = 0; i < 13; ++i) file.add_facet({i % 10, (i + 1) % 10, (i + 2) % 10});
  CHECK(parse_bytes(file.bytes()).num_facets() == 13);
}

TEST_CASE("OFF binary: normals, colours and texture of vertices and colours of facets are passed over") {
  struct Kind {
    const char* prefix;
    std::size_t extras;
  };
  for (const BinaryOff::Layout layout : binary_layouts)
    for (const auto& [prefix, extras] :
         {Kind{"N", 3}, Kind{"C", 4}, Kind{"ST", 2}, Kind{"CN", 7}, Kind{"STCN", 9}}) {
      CAPTURE(prefix);
      BinaryOff file(layout, std::string(prefix) + "OFF BINARY\n");
      file.add_counts(4, 2);
      for (const geom::Vec3& p : fixtures::tetrahedron().vertices()) {
        std::vector<double> numbers{p.x(), p.y(), p.z()};
        numbers.resize(3 + extras, .25);
        file.add_vertex(numbers);
      }
      file.add_facet({0, 1, 2}, {1, 0, 0, .5F});
      file.add_facet({0, 2, 3}, {1, 1, 0});
      const geom::TriMesh mesh = parse_bytes(file.bytes());
      CHECK(corners(mesh) == "0 1 2, 0 2 3");
      CHECK(mesh.vertices() == fixtures::tetrahedron().vertices());
    }
}

TEST_CASE("OFF binary: polygons, points, lines and repeated corners as in text") {
  for (const BinaryOff::Layout layout : binary_layouts) {
    BinaryOff file = binary_square(layout, 3);
    file.add_facet({0});
    file.add_facet({0, 1});
    file.add_facet({0, 1, 2, 3});
    const geom::TriMesh mesh = parse_bytes(file.bytes());
    CHECK(fixtures::identical(
        mesh, parse_bytes("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0\n2 0 1\n4 0 1 2 3\n")));
    CHECK(mesh.num_facets() == 2);

    BinaryOff twice = binary_square(layout, 2);
    twice.add_facet({0, 1, 1});
    twice.add_facet({0, 1, 2});
    CHECK(fault_of(twice.bytes()) == "a.off:byte 71: a facet names vertex 1 twice");
    std::size_t repeated = 0;
    CHECK(corners(io::parse_off({"a.off", twice.bytes()}, &repeated)) == "0 1 2");
    CHECK(repeated == 1);
  }
  BinaryOff none = binary_square(geomview, 2);
  none.add_facet({});
  none.add_facet({0, 1, 2});
  CHECK(corners(parse_bytes(none.bytes())) == "0 1 2");
}

TEST_CASE("OFF binary: truncated anywhere, or with a byte too many, in one line") {
  for (const BinaryOff::Layout layout : binary_layouts)
    for (const bool coloured : {false, true}) {
      BinaryOff file = binary_square(layout, 4);
      for (int i = 0; i < 4; ++i)
        file.add_facet({i, (i + 1) % 4, (i + 2) % 4},
                       coloured ? std::vector<float>{1, .5F, 0} : std::vector<float>{});
      const std::string& whole = file.bytes();
      REQUIRE(parse_bytes(whole).num_facets() == 4);
      for (std::size_t length = 0; length < whole.size(); ++length) {
        CAPTURE(length);
        const std::string fault = fault_of(whole.substr(0, length));
        CHECK(fault.starts_with("a.off:"));
        CHECK(fault.find('\n') == fault.npos);
      }
      CHECK(fault_of(whole + '\0').starts_with("a.off:byte "));
    }
}

TEST_CASE("OFF binary: the layout that is meant is the one that is complained of") {
  const auto fault = [](BinaryOff::Layout layout, std::size_t left) {
    return fault_of(binary_off(fixtures::tetrahedron(), layout).substr(0, left));
  };
  CHECK(fault(geomview, 10) == "a.off:byte 10: truncated: the file ends before the counts");
  for (const BinaryOff::Layout layout : binary_layouts) {
    CHECK(fault(layout, 20) == "a.off:byte 11: truncated: the file ends before the counts");
    CHECK(fault(layout, 60) ==
          "a.off:byte 11: truncated: the header promises 4 vertices and 4 facets, only 37 bytes follow");
  }
  CHECK(fault(geomview, 114) ==
        "a.off:byte 111: truncated: the file ends before facet 3 of 4");  // less than one number is none
  CHECK(fault(geomview, 130) == "a.off:byte 111: truncated: the file ends inside facet 3 of 4");
  CHECK(fault(geomview, 123) == "a.off:byte 111: truncated: facet 3 of 4 has 3 corners, only 8 bytes follow");
  CHECK(fault(without_colours, 134) ==
        "a.off:byte 119: truncated: facet 4 of 4 has 3 corners, only 11 bytes follow");
  CHECK(fault_of(binary_off(fixtures::tetrahedron(), geomview) + "x") ==
        "a.off:byte 151: more data than the header announces");
  CHECK(fault_of(binary_off(fixtures::tetrahedron(), without_colours) + "1234") ==
        "a.off:byte 135: more data than the header announces");
}

TEST_CASE("OFF binary: absurd numbers are refused before anything is stored") {
  constexpr std::uint32_t huge = std::numeric_limits<std::uint32_t>::max();
  for (const BinaryOff::Layout layout : binary_layouts) {
    for (const auto& [vertices, facets] : {std::pair(huge, 1U), std::pair(4U, huge), std::pair(huge, huge)}) {
      BinaryOff file(layout);
      file.add_counts(vertices, facets);
      for (int i = 0; i < 40; ++i) file.add(std::uint32_t{1});
      CHECK(fault_of(file.bytes()).starts_with("a.off:byte 11: truncated: the header promises "));
    }
    BinaryOff corners = binary_square(layout, 1);
    corners.add(huge);
    corners.add(1);
    CHECK(fault_of(corners.bytes()) ==
          "a.off:byte 71: truncated: facet 1 of 1 has 4294967295 corners, only 4 bytes follow");
  }
  BinaryOff colours = binary_square(geomview, 1);
  colours.add(1), colours.add(1), colours.add(huge);
  CHECK(fault_of(colours.bytes()) ==
        "a.off:byte 71: truncated: facet 1 of 1 has 4294967295 colour components, only 0 bytes follow");
  CHECK(fault_of(BinaryOff(geomview).bytes() + std::string(12, '\0')) == "a.off: no facets");
}

TEST_CASE("OFF binary: indices out of range, coordinates that are none, other headers") {
  for (const BinaryOff::Layout layout : binary_layouts) {
    for (const auto& [index, why] :
         {std::pair(4, "the file has 4 vertices"), std::pair(-1, "the first vertex is 0"),
          std::pair(1 << 30, "more than 2^30")}) {
      BinaryOff file = binary_square(layout, 1);
      file.add_facet({0, 1, index});
      CHECK(fault_of(file.bytes()) ==
            "a.off:byte 71: vertex index " + std::to_string(index) + " out of range (" + why + ")");
    }
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const auto& [odd, what] : {std::pair(std::numeric_limits<double>::quiet_NaN(), "not a number (NaN)"),
                                    std::pair(-infinite, "infinite or too large for a double")}) {
      BinaryOff file(layout);
      file.add_counts(3, 1);
      for (const double z : {0.0, odd, 0.0}) file.add_vertex({0, 0, z});
      file.add_facet({0, 1, 2});
      CHECK(fault_of(file.bytes()) == std::string("a.off:byte 35: a coordinate is ") + what);
    }
  }
  const std::string body = binary_off(fixtures::tetrahedron(), geomview).substr(11);
  for (const char* header : {"4OFF BINARY\n", "nOFF BINARY\n", "4nOFF BINARY\n"})
    CHECK(fault_of(header + body) == "a.off:1: no OFF header (OFF, COFF, NOFF, ...)");
  CHECK(fault_of("OFF BINARY 4 4 0\n" + body) == "a.off:1: '4' where the line should end");
  CHECK(fault_of("OFF\nBINARY\n" + body).starts_with("a.off:2: the number of vertices 'BINARY'"));
}
