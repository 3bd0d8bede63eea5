#include "io/off.h"

#include <array>
#include <cstdint>
#include <vector>

#include "io/binary_off.h"
#include "io/mesh_builder.h"
#include "io/numbers.h"
#include "io/text_cursor.h"

namespace io {

namespace {

struct Counts {
  std::size_t vertices, facets;
};

/// `why` ends the complaint that there is none.
void require_line(TextCursor& cursor, std::string_view kind, std::size_t index, std::size_t count,
                  std::string_view why = "") {
  if (cursor.next_line()) return;
  cursor.fail("truncated: the file ends before " + std::string(kind) + " " + std::to_string(index + 1) +
              " of " + std::to_string(count) + std::string(why));
}

std::size_t read_count(TextCursor& cursor, std::string_view word, std::string_view what) {
  const std::int64_t count = cursor.integer(word, what);
  if (count < 0) cursor.fail(std::string(what) + " is negative");
  return static_cast<std::size_t>(count);
}

/// The characters of a word that are a header, which the first count may follow without a blank; 0: none.
std::size_t header_length(std::string_view word) {
  std::size_t length = 0;
  for (const std::string_view part : {"ST", "C", "N"})
    if (word.substr(length).starts_with(part)) length += part.size();
  if (!word.substr(length).starts_with("OFF")) return 0;
  length += 3;
  const bool ends = length == word.size() || (word[length] >= '0' && word[length] <= '9');
  return ends ? length : 0;
}

/// The header, and the word behind it: the first count, unless it is on the next line, or BINARY.
struct OffHeader {
  std::string_view word, next;
};

OffHeader read_header(TextCursor& cursor) {
  const bool has_line = cursor.next_line();
  const std::string_view word = has_line ? cursor.word() : std::string_view();
  const std::size_t length = header_length(word);
  if (length == 0) cursor.fail("no OFF header (OFF, COFF, NOFF, ...)");
  const std::string_view next = word.substr(length);
  return {word.substr(0, length), next.empty() ? cursor.word() : next};
}

/// Both counts, which the bytes that follow can hold: a vertex takes at least the 6 bytes "0 0 0\n", a facet
/// the 2 bytes "0\n", the last of them may lack its line end.
Counts read_counts(TextCursor& cursor, std::string_view word) {
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

/// Numbers that a vertex of a binary file has behind its coordinates: a normal, a colour with its opacity, a
/// place in a texture.
std::size_t extras(std::string_view header) {
  std::size_t count = 0;
  for (const char letter : header) count += letter == 'N' ? 3 : letter == 'C' ? 4 : letter == 'S' ? 2 : 0;
  return count;
}

/// Behind the line that says BINARY.
std::size_t begin_of_body(TextCursor& cursor) {
  if (const std::string_view word = cursor.word(); !word.empty())
    cursor.fail(in_quotes(word) + " where the line should end");
  cursor.skip_line();
  return cursor.offset();
}

/// The facets, a new line each. One whose line ends too soon goes on in the next ones, for to the format a
/// line end is a blank; where a corner was forgotten, that takes the line of another facet, and one is
/// missing in the end: who went on first is named then.
class OffFacets {
 public:
  OffFacets(const InputFile& file, TextCursor& cursor, MeshBuilder& mesh)
      : file_(file), cursor_(cursor), mesh_(mesh) {}

  void read(std::size_t count) {
    std::string why;
    for (std::size_t i = 0; i < count; ++i) {
      require_line(cursor_, "facet", i, count, why);
      const std::size_t begin = cursor_.line();
      read_corners(begin);
      mesh_.add_facet(corners_, begin);
      if (why.empty() && cursor_.line() != begin)
        why = ", and the one of line " + std::to_string(begin) + " goes on in line " +
              std::to_string(cursor_.line());
    }
  }

 private:
  void read_corners(std::size_t begin) {
    const std::size_t degree = read_count(cursor_, cursor_.word(), "the number of corners");
    if (degree > cursor_.remaining())
      cursor_.fail("truncated: a facet of " + std::to_string(degree) + " corners");
    corners_.resize(degree);
    for (std::int64_t& corner : corners_) {
      const std::string_view word = cursor_.word_across_lines();
      if (word.empty())
        file_.fail({begin, Unit::line}, "truncated: the file ends inside the facet that begins here");
      corner = cursor_.integer(word, "vertex index");
    }
  }

  const InputFile& file_;
  TextCursor& cursor_;
  MeshBuilder& mesh_;
  std::vector<std::int64_t> corners_;
};

}  // namespace

bool is_off_header(std::string_view word) { return header_length(word) > 0; }

geom::TriMesh parse_off(const InputFile& file, std::size_t* repeated) {
  TextCursor cursor(file);
  const OffHeader header = read_header(cursor);
  if (header.next == "BINARY")
    return parse_binary_off(file, begin_of_body(cursor), extras(header.word), repeated);
  MeshBuilder mesh(file, Unit::line);
  const Counts counts = read_counts(cursor, header.next);
  for (std::size_t i = 0; i < counts.vertices; ++i) {
    require_line(cursor, "vertex", i, counts.vertices);
    std::array<double, 3> p{};
    for (double& x : p) x = cursor.coordinate(cursor.word());
    mesh.add_vertex({p[0], p[1], p[2]}, cursor.line());
  }
  OffFacets(file, cursor, mesh).read(counts.facets);
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
