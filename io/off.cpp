#include "io/off.h"

#include <array>
#include <cstdint>
#include <vector>

#include "io/mesh_builder.h"
#include "io/numbers.h"
#include "io/text_cursor.h"

namespace io {

namespace {

struct Counts {
  std::size_t vertices, facets;
};

void require_line(TextCursor& cursor, std::string_view kind, std::size_t index, std::size_t count) {
  if (cursor.next_line()) return;
  cursor.fail("truncated: the file ends before " + std::string(kind) + " " + std::to_string(index + 1) +
              " of " + std::to_string(count));
}

std::size_t read_count(TextCursor& cursor, std::string_view word, std::string_view what) {
  const std::int64_t count = cursor.integer(word, what);
  if (count < 0) cursor.fail(std::string(what) + " is negative");
  return static_cast<std::size_t>(count);
}

/// The header and both counts, which the bytes that follow can hold: a vertex takes at least the 6 bytes
/// "0 0 0\n", a facet the 2 bytes "0\n", the last of them may lack its line end.
Counts read_header(TextCursor& cursor) {
  const bool has_line = cursor.next_line();
  const std::string_view header = has_line ? cursor.word() : std::string_view();
  if (!is_off_header(header)) cursor.fail("no OFF header (OFF, COFF, NOFF, ...)");
  std::string_view word = cursor.word();
  if (word == "BINARY") cursor.fail("binary OFF is not supported");
  if (word.empty()) {
    if (!cursor.next_line()) cursor.fail("truncated: the file ends before the counts");
    word = cursor.word();
  }
  Counts counts{};
  counts.vertices = read_count(cursor, word, "the number of vertices");
  counts.facets = read_count(cursor, cursor.word(), "the number of facets");
  const std::size_t room = cursor.remaining() + 1;
  if (counts.vertices > room / 6 || counts.facets > (room - 6 * counts.vertices) / 2)
    cursor.fail("truncated: the header promises " + std::to_string(counts.vertices) + " vertices and " +
                std::to_string(counts.facets) + " facets, only " + std::to_string(cursor.remaining()) +
                " bytes follow");
  return counts;
}

}  // namespace

bool is_off_header(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

geom::TriMesh parse_off(const InputFile& file, std::size_t* repeated) {
  TextCursor cursor(file);
  MeshBuilder mesh(file, Unit::line);
  const Counts counts = read_header(cursor);
  for (std::size_t i = 0; i < counts.vertices; ++i) {
    require_line(cursor, "vertex", i, counts.vertices);
    std::array<double, 3> p{};
    for (double& x : p) x = cursor.coordinate(cursor.word());
    mesh.add_vertex({p[0], p[1], p[2]}, cursor.line());
  }
  std::vector<std::int64_t> corners;
  for (std::size_t i = 0; i < counts.facets; ++i) {
    require_line(cursor, "facet", i, counts.facets);
    const std::size_t degree = read_count(cursor, cursor.word(), "the number of corners");
    if (degree > cursor.remaining())
      cursor.fail("truncated: a facet of " + std::to_string(degree) + " corners");
    corners.clear();
    for (std::size_t k = 0; k < degree; ++k) corners.push_back(cursor.integer(cursor.word(), "vertex index"));
    mesh.add_facet(corners, cursor.line());
  }
  if (cursor.next_line()) cursor.fail("more lines than the header announces");
  return std::move(mesh).finish(repeated);
}

std::string to_off(const geom::TriMesh& mesh) {
  std::string text =
      "OFF\n" + std::to_string(mesh.num_vertices()) + " " + std::to_string(mesh.num_facets()) + " 0\n";
  for (const geom::Vec3& p : mesh.vertices()) {
    append_shortest(text, p.x());
    append_shortest(text += ' ', p.y());
    append_shortest(text += ' ', p.z());
    text += '\n';
  }
  for (const auto& facet : mesh.facets()) {
    text += '3';
    for (const geom::VertexId v : facet) append_integer(text += ' ', v.value);
    text += '\n';
  }
  return text;
}

}  // namespace io
