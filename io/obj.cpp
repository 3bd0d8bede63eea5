#include "io/obj.h"

#include <cstdint>
#include <vector>

#include "io/mesh_builder.h"
#include "io/numbers.h"
#include "io/text_cursor.h"

namespace io {

namespace {

void read_vertex(TextCursor& cursor, MeshBuilder& mesh) {
  const std::size_t line = cursor.line();
  const double x = cursor.coordinate(cursor.word());
  const double y = cursor.coordinate(cursor.word());
  const double z = cursor.coordinate(cursor.word());
  mesh.add_vertex({x, y, z}, line);
}

/// The 0-based vertex index of a corner "7", "7/1", "7//3", "7/1/3", "-1/-1".
std::int64_t read_corner(const TextCursor& cursor, std::string_view word, std::size_t num_vertices) {
  const std::size_t slash = word.find('/');
  const std::int64_t index = cursor.integer(word.substr(0, slash), "vertex index");
  if (slash != word.npos && word.find_first_not_of("0123456789+-/", slash) != word.npos)
    cursor.fail(in_quotes(word) + " is not a facet corner");
  if (index > 0) return index - 1;
  if (index == 0) cursor.fail("vertex index 0 (the first vertex is 1)");
  const std::int64_t counted_back = static_cast<std::int64_t>(num_vertices) + index;
  if (counted_back < 0)
    cursor.fail("vertex index " + std::to_string(index) + " out of range (" + std::to_string(num_vertices) +
                " vertices so far)");
  return counted_back;
}

}  // namespace

geom::TriMesh parse_obj(const InputFile& file, std::size_t* repeated) {
  TextCursor cursor(file, {.comment = '#', .continuation = true});
  MeshBuilder mesh(file, Unit::line, 1);
  std::vector<std::int64_t> corners;
  while (cursor.next_line()) {
    const std::string_view statement = cursor.word();
    if (statement == "v") {
      read_vertex(cursor, mesh);
    } else if (statement == "f" || statement == "fo") {
      const std::size_t line = cursor.line();
      corners.clear();
      for (auto word = cursor.word(); !word.empty(); word = cursor.word())
        corners.push_back(read_corner(cursor, word, mesh.num_vertices()));
      if (corners.size() < 3) cursor.fail("a facet needs three corners");
      mesh.add_facet(corners, line);
    }
  }
  return std::move(mesh).finish(repeated);
}

std::string to_obj(const geom::TriMesh& mesh) {
  std::string text;
  for (const geom::Vec3& p : mesh.vertices()) {
    text += 'v';
    for (const double x : p) append_shortest(text += ' ', x);
    text += '\n';
  }
  for (const auto& facet : mesh.facets()) {
    text += 'f';
    for (const geom::VertexId v : facet) append_integer(text += ' ', v.value + 1);
    text += '\n';
  }
  return text;
}

}  // namespace io
