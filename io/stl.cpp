#include "io/stl.h"

#include <array>
#include <cmath>
#include <limits>

#include "geom/check.h"
#include "io/byte_order.h"
#include "io/mesh_builder.h"
#include "io/text_cursor.h"
#include "io/vertex_welder.h"

namespace io {

using geom::Vec3;

namespace {

constexpr std::size_t header_size = 84;  // 80 free bytes and the number of facets
constexpr std::size_t record_size = 50;  // normal, three corners (12 floats), 2 free bytes

/// Adds facets given by positions.
class SoupBuilder {
 public:
  SoupBuilder(const InputFile& file, Unit unit) : mesh_(file, unit), welder_(mesh_) {}

  void add(const std::array<Vec3, 3>& corners, std::size_t place) {
    std::array<std::int64_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) ids[k] = welder_.id_of(corners[k], place).value;
    if (ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0]) mesh_.add_facet(ids, place);
  }
  geom::TriMesh finish() && { return std::move(mesh_).finish(); }

 private:
  MeshBuilder mesh_;
  VertexWelder welder_;
};

std::size_t promised_facets(std::string_view bytes) {
  return load_number<std::uint32_t>(bytes.data() + 80, std::endian::little);
}

geom::TriMesh parse_binary(const InputFile& file) {
  SoupBuilder soup(file, Unit::byte);
  for (std::size_t at = header_size; at < file.bytes.size(); at += record_size) {
    std::array<Vec3, 3> corners;
    const char* number = file.bytes.data() + at + 3 * sizeof(float);  // past the normal
    for (Vec3& p : corners)
      for (double& x : p) {
        x = load_number<float>(number, std::endian::little);
        number += sizeof(float);
      }
    soup.add(corners, at);
  }
  return std::move(soup).finish();
}

bool equal_ignoring_case(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

void expect(TextCursor& cursor, std::string_view keyword) {
  const std::string_view word = cursor.word_across_lines();
  if (word.empty())
    cursor.fail("truncated: the file ends where '" + std::string(keyword) + "' should follow");
  if (!equal_ignoring_case(word, keyword))
    cursor.fail(in_quotes(word) + " where '" + std::string(keyword) + "' should follow");
}

/// The rest of "facet normal nx ny nz outer loop vertex .. vertex .. vertex .. endloop endfacet".
std::array<Vec3, 3> read_facet(TextCursor& cursor) {
  expect(cursor, "normal");
  for (int k = 0; k < 3; ++k) cursor.word_across_lines();  // often wrong, sometimes NaN, never needed
  expect(cursor, "outer");
  expect(cursor, "loop");
  std::array<Vec3, 3> corners;
  for (Vec3& p : corners) {
    expect(cursor, "vertex");
    for (double& x : p) x = cursor.coordinate(cursor.word());
  }
  expect(cursor, "endloop");
  expect(cursor, "endfacet");
  return corners;
}

geom::TriMesh parse_text(const InputFile& file) {
  TextCursor cursor(file, {.comment = '\0', .continuation = false});
  SoupBuilder soup(file, Unit::line);
  bool inside = false;  // between "solid" and "endsolid"
  for (auto word = cursor.word_across_lines(); !word.empty(); word = cursor.word_across_lines()) {
    const std::size_t line = cursor.line();
    if (inside && equal_ignoring_case(word, "facet")) {
      soup.add(read_facet(cursor), line);
    } else if (equal_ignoring_case(word, inside ? "endsolid" : "solid")) {
      inside = !inside;
      cursor.skip_line();  // its name
    } else {
      cursor.fail(in_quotes(word) +
                  (inside ? " where 'facet' or 'endsolid' should follow" : " where 'solid' should follow"));
    }
  }
  if (inside) cursor.fail("truncated: the file ends before 'endsolid'");
  return std::move(soup).finish();
}

bool looks_like_text(std::string_view bytes) {
  constexpr std::string_view blanks = " \t\r\n\f\v";
  for (const char c : bytes.substr(0, 1024))
    if (static_cast<unsigned char>(c) < 0x20 && blanks.find(c) == blanks.npos) return false;
  const std::size_t first = bytes.find_first_not_of(blanks);
  return first != bytes.npos && equal_ignoring_case(bytes.substr(first, 5), "solid");
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_size && bytes.size() == header_size + record_size * promised_facets(bytes);
}

geom::TriMesh parse_stl(const InputFile& file) {
  if (is_binary_stl(file.bytes)) return parse_binary(file);
  if (looks_like_text(file.bytes)) return parse_text(file);
  if (file.bytes.size() < header_size)
    file.fail("truncated: neither a text STL nor 84 bytes of binary header");
  const std::size_t promised = promised_facets(file.bytes), bytes = file.bytes.size() - header_size;
  file.fail({80, Unit::byte}, (bytes < record_size * promised ? "truncated: " : "") +
                                  ("the header promises " + std::to_string(promised) +
                                   " facets of 50 bytes, " + std::to_string(bytes) + " bytes follow"));
}

namespace {

constexpr double most_steps = 1.0 / 50;  // of an edge

double mean_edge(const geom::TriMesh& mesh) {
  double sum = 0;
  for (const auto& facet : mesh.facets())
    for (std::size_t i = 0; i < 3; ++i)
      sum += (mesh.position(facet[i]) - mesh.position(facet[(i + 1) % 3])).norm();
  return sum / (3 * static_cast<double>(std::max<std::size_t>(mesh.num_facets(), 1)));
}

}  // namespace

void require_stl_edges(const geom::TriMesh& surface, double edge) {
  double largest = 0;
  for (const auto& facet : surface.facets())
    for (const geom::VertexId v : facet)
      largest = std::max(largest, surface.position(v).cwiseAbs().maxCoeff());
  geom::require(largest * 0x1p-23 <= most_steps * edge,
                "STL's single precision is too coarse for edges that short so far from the origin");
}

void require_stl(const geom::TriMesh& mesh) {
  geom::require(mesh.num_facets() <= std::numeric_limits<std::uint32_t>::max(), "too many facets for STL");
  double largest = 0;
  for (const Vec3& p : mesh.vertices()) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  geom::require(largest <= std::numeric_limits<float>::max(),
                "a coordinate is beyond STL's single precision");
  // What is 2^24 times smaller than that is still a normal number.
  geom::require(largest == 0 || largest >= 0x1p-102,
                "the coordinates are too small for STL's single precision");
  if (mesh.num_facets() > 0) require_stl_edges(mesh, mean_edge(mesh));
}

std::string to_stl(const geom::TriMesh& mesh) {
  require_stl(mesh);
  std::string bytes = "binary STL";
  bytes.resize(80, ' ');
  append_little(bytes, static_cast<std::uint32_t>(mesh.num_facets()));
  const auto append = [&bytes](const Vec3& p) {
    for (const double x : p) append_little(bytes, static_cast<float>(x));
  };
  for (const auto& facet : mesh.facets()) {
    const Vec3 &a = mesh.position(facet[0]), &b = mesh.position(facet[1]), &c = mesh.position(facet[2]);
    const Vec3 normal = (b - a).cross(c - a);
    append(normal.norm() > 0 ? normal.normalized() : Vec3(Vec3::Zero()));
    append(a), append(b), append(c);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace io
