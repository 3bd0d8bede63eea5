#include "io/attributes.h"

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "io/extension.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "io/numbers.h"
#include "io/polygon.h"
#include "io/text_cursor.h"

namespace io {

using geom::VertexId;

namespace {

/// Walks an OBJ file that parse_obj() has taken, so that indices are sound.
class ObjAttributes {
 public:
  explicit ObjAttributes(const InputFile& file) : cursor_(file, {.comment = '#', .continuation = true}) {}

  Attributes read() {
    while (cursor_.next_line()) read_statement(cursor_.word());
    finish();
    return std::move(result_);
  }

 private:
  struct Corner {
    std::int64_t vertex, texture;
  };

  void read_statement(std::string_view statement) {
    if (statement == "v") return read_vertex();
    if (statement == "vt") return read_texture();
    if (statement == "f" || statement == "fo") return read_facet();
    if (statement == "l") return read_line();
    if (statement == "g" || statement == "o" || statement == "usemtl") return read_part(statement);
  }

  void read_vertex() {
    geom::Vec3 position;
    for (double& x : position) x = cursor_.coordinate(cursor_.word());
    result_.vertices.push_back(position);
    std::vector<double> rest;
    for (auto word = cursor_.word(); !word.empty(); word = cursor_.word()) {
      const double number = parse_real(word).value_or(0);
      rest.push_back(std::isfinite(number) ? number : 0);
    }
    if (rest.size() == 1 || rest.size() == 4) rest.erase(rest.begin());  // w comes first
    colours_ += rest.size() >= 3;
    rest.resize(3, 1.0);  // who has no colour is white
    for (std::size_t i = 0; i < 3; ++i) colour_[i].push_back(rest[i]);
  }

  void read_texture() {
    const double u = cursor_.coordinate(cursor_.word());
    const auto v = cursor_.word();
    result_.texture.push_back({u, v.empty() ? 0 : cursor_.coordinate(v)});
  }

  /// From 0; -1: none. Negative numbers count from the last.
  std::int64_t index(std::string_view word, std::size_t count) const {
    if (word.empty()) return -1;
    const std::int64_t number = cursor_.integer(word, "index");
    const std::int64_t i = number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
    if (number == 0 || i < 0) cursor_.fail("index " + std::to_string(number) + " out of range");
    return i;
  }

  Corner corner(std::string_view word) const {
    const std::size_t first = word.find('/');
    Corner result{index(word.substr(0, first), result_.vertices.size()), -1};
    if (first == word.npos) return result;
    const std::string_view rest = word.substr(first + 1);
    result.texture = index(rest.substr(0, rest.find('/')), result_.texture.size());
    return result;
  }

  void read_facet() {
    Facet& facet = facets_.emplace_back();
    facet.part = part_;
    for (auto word = cursor_.word(); !word.empty(); word = cursor_.word())
      facet.corners.push_back(corner(word));
  }

  void read_line() {
    std::vector<VertexId>& line = result_.lines.emplace_back();
    for (auto word = cursor_.word(); !word.empty(); word = cursor_.word()) {
      const std::int64_t v = corner(word).vertex;
      if (v >= static_cast<std::int64_t>(result_.vertices.size())) cursor_.fail("a line of no vertex");
      line.push_back(VertexId(static_cast<std::size_t>(v)));
    }
  }

  void read_part(std::string_view statement) {
    std::string name;
    for (auto word = cursor_.word(); !word.empty(); word = cursor_.word()) name += " " + std::string(word);
    names_[std::string(statement)] = name;
    const auto [at, added] = parts_.try_emplace(names_, static_cast<std::int32_t>(parts_.size()));
    part_ = at->second;
  }

  void finish() {
    if (colours_ > 0)
      for (std::size_t i = 0; i < 3; ++i)
        result_.properties.push_back(
            {std::array{"red", "green", "blue"}[i], PlyType::float64, std::move(colour_[i])});
    for (const Facet& facet : facets_) result_.parts |= facet.part != facets_.front().part;
    if (result_.parts || !result_.texture.empty())
      for (const Facet& facet : facets_) append_triangles(facet);
  }

  struct Facet {
    std::vector<Corner> corners;
    std::int32_t part;
  };

  void append_triangles(const Facet& facet) {
    std::vector<geom::Vec3> polygon;
    for (const Corner& c : facet.corners) {
      if (c.vertex >= static_cast<std::int64_t>(result_.vertices.size())) return;
      polygon.push_back(result_.vertices[VertexId(static_cast<std::size_t>(c.vertex))]);
    }
    if (polygon.size() == 3) return append(facet, {0, 1, 2});
    for (const std::array<int, 3>& triangle : triangulate(polygon)) append(facet, triangle);
  }

  void append(const Facet& facet, const std::array<int, 3>& corners) {
    AttributedTriangle triangle{{}, {}, facet.part};
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner& c = facet.corners[static_cast<std::size_t>(corners[i])];
      triangle.vertices[i] = VertexId(static_cast<std::size_t>(c.vertex));
      const bool known = c.texture < static_cast<std::int64_t>(result_.texture.size());
      triangle.texture[i] = known ? static_cast<std::int32_t>(c.texture) : -1;
    }
    result_.triangles.push_back(triangle);
  }

  TextCursor cursor_;
  Attributes result_;
  std::array<std::vector<double>, 3> colour_;
  std::size_t colours_ = 0;  ///< vertices that have one
  std::vector<Facet> facets_;
  std::map<std::string, std::string> names_;  ///< the group, object and material at hand
  std::map<std::map<std::string, std::string>, std::int32_t> parts_;
  std::int32_t part_ = -1;
};

/// Texture coordinates of the faces of a PLY file. Corners of one vertex with the same coordinates share
/// them.
class PlyTextures {
 public:
  explicit PlyTextures(Attributes& result) : result_(result) {}

  /// Faces of one or two corners are none.
  void add(const PlyFace& face) {
    if (face.corners.size() < 3) return;
    std::vector<geom::Vec3> polygon;
    std::vector<std::int32_t> texture;
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      const VertexId v(static_cast<std::size_t>(face.corners[i]));
      polygon.push_back(result_.vertices[v]);
      const bool known = face.texture.size() == 2 * face.corners.size();
      texture.push_back(known ? number_of(v, {face.texture[2 * i], face.texture[2 * i + 1]}) : -1);
    }
    if (polygon.size() == 3) return append(face, texture, {0, 1, 2});
    for (const std::array<int, 3>& triangle : triangulate(polygon)) append(face, texture, triangle);
  }

 private:
  std::int32_t number_of(VertexId v, const geom::Vec2& at) {
    if (!at.allFinite()) return -1;
    const auto next = static_cast<std::int32_t>(result_.texture.size());
    const auto [known, added] = numbers_.try_emplace({v, at.x(), at.y()}, next);
    if (added) result_.texture.push_back(at);
    return known->second;
  }

  void append(const PlyFace& face, const std::vector<std::int32_t>& texture,
              const std::array<int, 3>& corners) {
    AttributedTriangle triangle{{}, {}, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto corner = static_cast<std::size_t>(corners[i]);
      triangle.vertices[i] = VertexId(static_cast<std::size_t>(face.corners[corner]));
      triangle.texture[i] = texture[corner];
    }
    result_.triangles.push_back(triangle);
  }

  Attributes& result_;
  std::map<std::tuple<VertexId, double, double>, std::int32_t> numbers_;
};

Attributes ply_attributes(const InputFile& file, const std::filesystem::path& path) {
  Attributes result;
  std::size_t repeated = 0;
  result.vertices = read_mesh(path, repeated).vertices();
  result.properties = parse_ply_properties(file);
  for (const PlyElement& element : parse_ply_header(file).elements)
    if (element.name == "face")
      for (const PlyProperty& property : element.properties)
        result.dropped |= property.name != "texcoord" && !property.name.starts_with("vertex_ind");
  PlyTextures textures(result);
  for (const PlyFace& face : parse_ply_faces(file)) textures.add(face);
  return result;
}

}  // namespace

Attributes read_attributes(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".obj") {
    const InputFile file = load(path);
    return ObjAttributes(file).read();
  }
  if (extension == ".ply") return ply_attributes(load(path), path);
  Attributes result;
  std::size_t repeated = 0;
  result.vertices = read_mesh(path, repeated).vertices();
  return result;
}

}  // namespace io
