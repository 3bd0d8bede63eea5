#include "tools/remesh_features.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fpo/features/feature_samples.h"
#include "geom/mesh/edges.h"
#include "io/attributes.h"
#include "io/input_file.h"
#include "io/text_cursor.h"
#include "tools/own_vertices.h"

namespace tools {

using geom::Vec3;
using geom::VertexId;

namespace {

using Edge = std::array<VertexId, 2>;

/// Vertices of the file, and those of the surface that lie where they do.
class Places {
 public:
  Places(const geom::TriMesh& mesh, const geom::Table<VertexId, Vec3>& file)
      : first_(own_vertices(file, file)), here_(file.size()), edges_(geom::edges_of(mesh)) {
    const auto own = own_vertices(mesh.vertices(), file);
    for (VertexId v(0); v.index() < own.size(); v = VertexId(v.value + 1))
      if (own[v].valid()) here_[own[v]].push_back(v);
  }

  /// The same vertex for all at its place.
  VertexId first(VertexId v) const { return first_[v]; }

  /// Adds the surface's edges between the places of two vertices of the file. False if there is none.
  bool add(VertexId a, VertexId b, std::vector<Edge>& out) const {
    bool found = false;
    for (const VertexId i : here_[first_[a]])
      for (const VertexId j : here_[first_[b]]) {
        const geom::MeshEdge edge = geom::mesh_edge(i, j);
        if (!std::ranges::binary_search(edges_, edge)) continue;
        out.push_back({edge.first, edge.second});
        found = true;
      }
    return found;
  }

 private:
  geom::Table<VertexId, VertexId> first_;
  geom::Table<VertexId, std::vector<VertexId>> here_;
  std::vector<geom::MeshEdge> edges_;
};

/// What the triangle on one side of an edge has there, beside its ends.
struct Side {
  std::array<std::int32_t, 2> texture;
  std::int32_t part;
};

std::map<Edge, std::vector<Side>> sides_of(const io::Attributes& attributes, const Places& places) {
  std::map<Edge, std::vector<Side>> sides;
  for (const io::AttributedTriangle& t : attributes.triangles)
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t f = (e + 1) % 3;
      Edge edge{places.first(t.vertices[e]), places.first(t.vertices[f])};
      Side side{{t.texture[e], t.texture[f]}, t.part};
      if (edge[1] < edge[0]) std::swap(edge[0], edge[1]), std::swap(side.texture[0], side.texture[1]);
      sides[edge].push_back(side);
    }
  return sides;
}

bool same_texture(const io::Attributes& attributes, std::int32_t a, std::int32_t b) {
  if (a < 0 || b < 0) return a == b;
  return attributes.texture[static_cast<std::size_t>(a)] == attributes.texture[static_cast<std::size_t>(b)];
}

void mark_seams_and_groups(const FeatureWords& wanted, const io::Attributes& attributes, const Places& places,
                           std::vector<Edge>& marked) {
  for (const auto& [edge, sides] : sides_of(attributes, places))
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const Side &a = sides[0], &b = sides[i];
      const bool seam = !same_texture(attributes, a.texture[0], b.texture[0]) ||
                        !same_texture(attributes, a.texture[1], b.texture[1]);
      if ((wanted.seams && seam) || (wanted.groups && a.part != b.part)) places.add(edge[0], edge[1], marked);
    }
}

/// The pieces of a line that are no edges are counted.
void mark_line(const std::vector<VertexId>& line, const Places& places, std::vector<Edge>& marked,
               std::array<std::size_t, 2>& missing_of_all) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    missing_of_all[0] += !places.add(line[i], line[i + 1], marked);
    ++missing_of_all[1];
  }
}

/// Nearest vertices of a mesh of any size, within 1e-6 of its diagonal.
std::vector<std::vector<VertexId>> read_lines(const std::filesystem::path& path, const geom::TriMesh& mesh,
                                              const geom::Table<VertexId, Vec3>& vertices) {
  const io::InputFile file = io::load(path);
  io::TextCursor cursor(file);
  std::vector<std::vector<VertexId>> lines;
  const double tolerance = 1e-6 * mesh.diagonal();
  for (std::size_t last = 0; cursor.next_line(); last = cursor.line()) {
    if (lines.empty() || cursor.line() > last + 1) lines.emplace_back();
    Vec3 x;
    for (double& coordinate : x) coordinate = cursor.coordinate(cursor.word());
    if (!cursor.word().empty()) cursor.fail("more than x, y and z");
    VertexId nearest(0);
    for (VertexId v(0); v.index() < vertices.size(); v = VertexId(v.value + 1))
      if ((vertices[v] - x).stableNorm() < (vertices[nearest] - x).stableNorm()) nearest = v;
    if ((vertices[nearest] - x).stableNorm() > tolerance) cursor.fail("no vertex of the input is there");
    lines.back().push_back(nearest);
  }
  if (lines.empty()) file.fail("no points");
  return lines;
}

void note_missing(const std::string& what, const std::array<std::size_t, 2>& missing_of_all,
                  SurfaceInput& input) {
  if (missing_of_all[0] > 0)
    input.notes.push_back("warning: features: " + what + ": " + std::to_string(missing_of_all[0]) + " of " +
                          std::to_string(missing_of_all[1]) + " pieces are no edges of the input");
}

/// An angle, or no angle at all but auto's.
std::optional<double> set_word(RemeshArguments& a, const std::string& word, bool& creases) {
  FeatureWords& wanted = a.feature_words;
  if (word == "none") return {};
  if (word == "auto") return creases = true, -1;
  if (word == "seams") return wanted.seams = true, std::nullopt;
  if (word == "groups") return wanted.groups = true, std::nullopt;
  if (word == "lines") return wanted.lines = true, std::nullopt;
  const bool number = !word.empty() && word.find_first_not_of("0123456789.eE+-") == std::string::npos;
  if (number) return creases = true, parse_number(word, 1, 180);
  std::error_code unknown;
  geom::require(std::filesystem::exists(word, unknown),
                "'" + word + "' is not auto, none, an angle, seams, groups, lines or a file");
  wanted.files.emplace_back(word);
  return {};
}

}  // namespace

void set_features(RemeshArguments& a, const std::string& text) {
  a.feature_words = {};
  a.remesh.features.reset();
  bool creases = false;
  std::optional<double> angle;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::optional<double> said = set_word(a, text.substr(begin, end - begin), creases);
    if (said) angle = said;
    begin = end + 1;
  }
  if (creases) {
    a.remesh.features = fpo::automatic_features();
    if (*angle >= 0)
      a.remesh.features = fpo::FeatureOptions{.crease_angle = *angle, .weak_crease_angle = *angle};
  } else if (a.feature_words.any()) {  // borders, and what is marked
    a.remesh.features = fpo::FeatureOptions{.crease_angle = 180, .weak_crease_angle = 180};
  }
}

void mark_features(RemeshArguments& a, SurfaceInput& input) {
  const FeatureWords& wanted = a.feature_words;
  if (!wanted.any()) return;
  const io::Attributes attributes = io::read_attributes(a.input);
  const Places places(input.mesh, attributes.vertices);
  std::vector<Edge>& marked = a.remesh.features->marked;
  mark_seams_and_groups(wanted, attributes, places, marked);
  std::array<std::size_t, 2> missing_of_all{};
  if (wanted.lines)
    for (const auto& line : attributes.lines) mark_line(line, places, marked, missing_of_all);
  note_missing("lines", missing_of_all, input);
  for (const std::filesystem::path& path : wanted.files) {
    missing_of_all = {};
    for (const auto& line : read_lines(path, input.mesh, attributes.vertices))
      mark_line(line, places, marked, missing_of_all);
    note_missing(io::display_name(path), missing_of_all, input);
  }
}

}  // namespace tools
