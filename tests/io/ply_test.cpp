#include "io/ply.h"

#include <cstdint>

#include "doctest.h"
#include "io/byte_order.h"
#include "tests/io/sample_meshes.h"

using fixtures::complaint;
using fixtures::corners;

namespace {

geom::TriMesh parse_ply(std::string bytes) { return io::parse_ply({"a.ply", std::move(bytes)}); }

template <class T>
void append(std::string& bytes, T value, bool big) {
  std::string little;
  io::append_little(little, value);
  bytes += big ? std::string(little.rbegin(), little.rend()) : little;
}

const std::string header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("PLY: texture coordinates of faces, in text and binary") {
  const std::string textured =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
      "property int texnumber\nend_header\n" +
      ply_square + "3 0 1 2 6 0 0 0.5 0 0.5 1 7\n4 0 1 2 3 0 7\n";
  const std::vector<io::PlyFace> faces = io::parse_ply_faces({"a.ply", textured});
  REQUIRE(faces.size() == 2);
  CHECK(faces[0].corners == std::vector<std::int64_t>{0, 1, 2});
  CHECK(faces[0].texture == std::vector<double>{0, 0, 0.5, 0, 0.5, 1});
  CHECK(faces[1].corners.size() == 4);
  CHECK(faces[1].texture.empty());
  CHECK(io::parse_ply_faces({"a.ply", header + ply_square + "3 0 1 2\n3 0 2 3\n"}).empty());
}

TEST_CASE("PLY text: comments, Windows line ends, records over several lines") {
  const std::string text = header + ply_square + "3 0 1 2\n3 0 2 3\n";
  CHECK(corners(parse_ply(text)) == "0 1 2, 0 2 3");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(corners(parse_ply(windows)) == "0 1 2, 0 2 3");
  std::string commented = text;
  commented.insert(4, "comment made by hand\nobj_info 3\n\n");
  CHECK(corners(parse_ply(commented)) == "0 1 2, 0 2 3");
  CHECK(corners(parse_ply(header + "0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3")) == "0 1 2, 0 2 3");
}

TEST_CASE("PLY text: other elements, other properties, lists anywhere, any order, vertex_index, polygons") {
  const auto mesh = parse_ply(
      "ply\nformat ascii 1.0\n"
      "element camera 1\nproperty float angle\nproperty list int float matrix\n"
      "element face 2\nproperty uchar red\nproperty list int uint vertex_index\nproperty list uchar float "
      "uv\n"
      "element nothing 77777777777\n"
      "element vertex 4\nproperty double nx\nproperty list uchar int tags\nproperty double z\nproperty int "
      "y\n"
      "property uchar x\nproperty float weight\n"
      "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
      "end_header\n"
      "0.5 2 1e9 -7\n"
      "255 4 0 1 2 3 2 0.5 0.5\n"
      "0 2 0 1 0\n"
      "nan 0 0 0 0 1\n9 1 5 0 0 1 1\n9 2 5 5 0 1 1 1\n9 0 2.5 1 0 1\n"
      "0 1\n");
  CHECK(mesh.num_facets() == 2);
  CHECK(mesh.position(geom::VertexId(3)) == geom::Vec3(0, 1, 2.5));
}

TEST_CASE("PLY binary: both byte orders, all types, unaligned records") {
  for (const bool big : {false, true}) {
    CAPTURE(big);
    std::string bytes =
        std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\nelement vertex 3\nproperty uint8 flag\nproperty float64 x\nproperty list uint16 int16 "
        "marks\nproperty int16 y\nproperty float32 z\nelement face 2\nproperty list int8 uint32 "
        "vertex_index\nproperty char c\nend_header\n";
    for (int i = 0; i < 3; ++i) {
      append(bytes, std::uint8_t(i), big);
      append(bytes, i == 1 ? 0.1 : 10.0, big);  // 10 is the line end's code in text
      append(bytes, std::uint16_t(i), big);
      for (int k = 0; k < i; ++k) append(bytes, std::int16_t(2570), big);
      append(bytes, std::int16_t(-300 * i), big);
      append(bytes, 0.25f, big);
    }
    for (const std::uint32_t first : {0u, 2u}) {
      append(bytes, std::int8_t(3), big);
      append(bytes, first, big);
      append(bytes, 1u, big);
      append(bytes, 2u - first, big);
      append(bytes, '\n', big);
    }
    const auto mesh = parse_ply(bytes);
    CHECK(corners(mesh) == "0 1 2, 2 1 0");
    CHECK(mesh.position(geom::VertexId(1)) == geom::Vec3(0.1, -300, 0.25));
    CHECK(complaint([&] { parse_ply(bytes + "\n"); }).ends_with(": more data than the header announces"));
    for (std::size_t size = 4; size < bytes.size(); ++size) {
      const std::string message = complaint([&] { parse_ply(bytes.substr(0, size)); });
      CHECK(message.starts_with("a.ply:"));
    }
  }
}

TEST_CASE("PLY binary: a header with Windows line ends, a body that starts with a line end's code") {
  std::string bytes = io::to_ply(fixtures::tetrahedron());
  const std::size_t body = bytes.find("end_header\n") + 11;
  bytes[body] = '\n';  // the last bits of the first x
  const double x = io::load_number<double>(bytes.data() + body, std::endian::little);
  CHECK(parse_ply(bytes).position(geom::VertexId(0)).x() == x);
  std::string windows;
  for (std::size_t i = 0; i < body; ++i) windows += bytes[i] == '\n' ? "\r\n" : std::string(1, bytes[i]);
  CHECK(fixtures::identical(parse_ply(windows + bytes.substr(body)), parse_ply(bytes)));
}

TEST_CASE("PLY: triangle strips, in text and both byte orders, beside faces and alone") {
  const std::vector<std::int32_t> strip{0, 1, 3, 2, -1, -1, 3, 2, -1, 2, 2, 0, 0, 3, 2, 1};
  const std::string triangles = "0 1 3, 3 1 2, 3 0 2, 3 2 1";  // every other one is turned over
  const auto strips_header = [](const std::string& format) {
    return "ply\nformat " + format +
           " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element tristrips 1\nproperty list int int vertex_indices\n";
  };
  std::string text;
  for (const std::int32_t v : strip) text += " " + std::to_string(v);
  CHECK(corners(parse_ply(strips_header("ascii") + "end_header\n" + ply_square + "16" + text)) == triangles);
  const std::string beside = strips_header("ascii") +
                             "element face 1\nproperty list uchar int vertex_index\nend_header\n" +
                             ply_square + "4 0 1 -1 2\n3 1 2 3\n";
  CHECK(corners(parse_ply(beside)) == "1 2 3");
  for (const bool big : {false, true}) {
    CAPTURE(big);
    std::string bytes = strips_header(big ? "binary_big_endian" : "binary_little_endian") + "end_header\n";
    for (const float x : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) append(bytes, x, big);
    append(bytes, static_cast<std::int32_t>(strip.size()), big);
    for (const std::int32_t v : strip) append(bytes, v, big);
    CHECK(corners(parse_ply(bytes)) == triangles);
    CHECK(complaint([&] { parse_ply(bytes.substr(0, bytes.size() - 4)); }).find("truncated") !=
          std::string::npos);
  }
}

TEST_CASE("PLY: a band cut into strips is turned one way") {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 12\nproperty int x\nproperty int y\n"
      "property int z\nelement tristrips 2\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
  const auto mesh = parse_ply(text + "7 0 1 2 3 4 5 6\n7 5 7 6 8 -1 7 9\n");
  for (const auto& [a, b, c] : mesh.facets()) {
    CAPTURE(a.value);
    const geom::Vec3 ab = mesh.position(b) - mesh.position(a), ac = mesh.position(c) - mesh.position(a);
    CHECK(ab.cross(ac).z() == -1);
  }
  CHECK(mesh.num_facets() == 7);
}

TEST_CASE("PLY: faults of triangle strips are named") {
  const auto fault = [](const std::string& list, const std::string& strip) {
    return complaint([&] {
      parse_ply(
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
          "property float z\nelement tristrips 1\nproperty " +
          list + "\nend_header\n" + ply_square + strip);
    });
  };
  const std::string list = "list int int vertex_indices";
  CHECK(fault(list, "4 0 1 2 3\n").empty());
  CHECK(fault(list, "4 0 1 2 4\n") == "a.ply:14: vertex index 4 out of range (the file has 4 vertices)");
  CHECK(fault(list, "4 0 1 2 -2\n") == "a.ply:14: vertex index -2 out of range (the first vertex is 0)");
  CHECK(fault(list, "9 0 1 2 3\n").starts_with("a.ply:14: truncated: "));
  CHECK(fault(list, "-1 0 1 2 3\n") == "a.ply:14: a list of negative length");
  CHECK(fault(list, "4 0 1 -1 3\n") == "a.ply: no facets");
  CHECK(fault("list int float vertex_indices", "3 0 1 2\n") ==
        "a.ply: the tristrips have no list of integers 'vertex_indices' or 'vertex_index'");
}

TEST_CASE("PLY: each fault is named with its place") {
  const auto fault = [](const std::string& bytes) { return complaint([&] { parse_ply(bytes); }); };
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = header + ply_square + "3 0 1 2\n3 0 2 3\n";
  CHECK(fault(good.substr(1)) == "a.ply:1: no PLY header ('ply' on the first line)");
  CHECK(fault("ply\nformat ascii 1.0\n") == "a.ply:3: truncated: the file ends before 'end_header'");
  CHECK(fault(with(good, "ascii", "morse")).starts_with("a.ply:2: 'morse' is not a PLY format"));
  CHECK(fault(with(good, "format ascii 1.0\n", "")) == "a.ply:8: the header names no format");
  CHECK(fault(with(good, "float x", "half x")) == "a.ply:4: 'half' is not a PLY type");
  CHECK(fault(with(good, "float x", "float")) == "a.ply:4: a property has no name");
  CHECK(fault(with(good, "float x", "float q")) == "a.ply: the vertices have no number 'x'");
  CHECK(fault(with(good, "float x", "list int float x")) == "a.ply: the vertices have no number 'x'");
  CHECK(fault(with(good, "element vertex", "element vertices")) == "a.ply: no element 'vertex'");
  CHECK(fault(with(good, "element face", "element faces")) == "a.ply: no facets");
  CHECK(fault(with(good, "face 2", "vertex 2")) == "a.ply:7: element 'vertex' appears twice");
  CHECK(fault(with(good, "vertex 4", "vertex -4")) == "a.ply:3: the number of elements is negative");
  CHECK(fault(with(good, "uchar int", "float int")) ==
        "a.ply:8: the length of a list must be of an integer type");
  CHECK(
      fault(with(good, "uchar int", "uchar float")).starts_with("a.ply: the faces have no list of integers"));
  CHECK(fault(with(good, "vertex 4", "vertex 4000000000000000000"))
            .starts_with("a.ply:10: truncated: the header promises 4000000000000000000 records 'vertex'"));
  CHECK(fault(with(good, "face 2", "face 3")) ==
        "a.ply:16: truncated: the file ends inside the promised elements");
  CHECK(fault(with(good, "face 2", "face 1")) == "a.ply:15: more data than the header announces");
  CHECK(fault(with(good, "3 0 1 2", "3 0 1 4")) ==
        "a.ply:14: vertex index 4 out of range (the file has 4 vertices)");
  CHECK(fault(with(good, "3 0 1 2", "3 0 1 1")) == "a.ply:14: a facet names vertex 1 twice");
  CHECK(fault(with(good, "3 0 1 2", "-3 0 1 2")) == "a.ply:14: a list of negative length");
  CHECK(fault(with(good, "3 0 1 2", "300 0 1 2")) == "a.ply:14: truncated: a list of 300 numbers");
  CHECK(fault(with(good, "3 0 1 2", "3 0 1 two")).starts_with("a.ply:14: "));
  CHECK(fault(with(good, "1 1 0", "1 nan 0")) == "a.ply:12: a coordinate is not a number (NaN)");
  CHECK(fault(with(good, "1 1 0", "1 -1e49 0")).starts_with("a.ply:12: a coordinate is beyond 1e48"));
  CHECK(fault(with(good, "1 1 0", "1 1_ 0")) == "a.ply:12: '1_' is not a number");
  CHECK(fault(with(with(good, "face 2", "face 0"), "3 0 1 2\n3 0 2 3\n", "")) == "a.ply: no facets");

  const std::string binary = io::to_ply(fixtures::tetrahedron());
  const std::size_t body = binary.find("end_header\n") + 11;
  std::string wrong = binary;
  wrong[body + 4 * 24 + 1] = 100;  // a corner of the first facet
  CHECK(fault(wrong) == "a.ply:byte " + std::to_string(body + 96) +
                            ": vertex index 100 out of range (the file has 4 vertices)");
  wrong = binary;
  wrong[body + 7] = wrong[body + 6] = '\xff';
  CHECK(fault(wrong) == "a.ply:byte " + std::to_string(body + 8) + ": a coordinate is not a number (NaN)");
  CHECK(fault(binary.substr(0, binary.size() - 1)).find("truncated") != std::string::npos);
}
