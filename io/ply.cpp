#include "io/ply.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "io/byte_order.h"
#include "io/mesh_builder.h"
#include "io/numbers.h"
#include "io/ply_header.h"
#include "io/text_cursor.h"

namespace io {

namespace {

/// The numbers of a text body: words, whatever lines they are on.
class TextValues {
 public:
  TextValues(const InputFile& file, const PlyHeader& header)
      : cursor_(file, {.comment = '\0', .continuation = false}, header.body, header.body_line) {}

  static constexpr Unit unit = Unit::line;
  std::size_t place() {
    cursor_.find_word();
    return cursor_.line();
  }
  std::size_t room(PlyType) const { return cursor_.remaining() / 2 + 1; }  ///< numbers that may still follow
  double real(PlyType) {
    const auto value = parse_real(word());
    if (!value) cursor_.fail(in_quotes(last_) + " is not a number");
    return *value;
  }
  std::int64_t integer(PlyType) { return cursor_.integer(word(), "the integer"); }
  void skip(PlyType, std::size_t count) {
    for (; count > 0; --count) word();
  }
  bool at_end() { return !cursor_.find_word(); }
  [[noreturn]] void fail(std::string_view what) const { cursor_.fail(what); }

 private:
  std::string_view word() {
    last_ = cursor_.word_across_lines();
    if (last_.empty()) cursor_.fail("truncated: the file ends inside the promised elements");
    return last_;
  }

  TextCursor cursor_;
  std::string_view last_;
};

/// The numbers of a binary body.
class BinaryValues {
 public:
  BinaryValues(const InputFile& file, const PlyHeader& header)
      : file_(&file), at_(header.body), order_(*header.binary) {}

  static constexpr Unit unit = Unit::byte;
  std::size_t place() const { return at_; }
  std::size_t room(PlyType type) const { return (file_->bytes.size() - at_) / size_of(type); }
  double real(PlyType type) {
    if (type == PlyType::float64) return take<double>();
    if (type == PlyType::float32) return take<float>();
    return static_cast<double>(integer(type));
  }
  std::int64_t integer(PlyType type) {
    using enum PlyType;
    switch (type) {
      case int8:
        return take<std::int8_t>();
      case uint8:
        return take<std::uint8_t>();
      case int16:
        return take<std::int16_t>();
      case uint16:
        return take<std::uint16_t>();
      case int32:
        return take<std::int32_t>();
      case uint32:
        return take<std::uint32_t>();
      case float32:
      case float64:
        break;
    }
    fail("a floating-point number where an integer is needed");
  }
  void skip(PlyType type, std::size_t count) {
    if (count > room(type)) fail_truncated();
    at_ += count * size_of(type);
  }
  bool at_end() const { return at_ == file_->bytes.size(); }
  [[noreturn]] void fail(std::string_view what) const { file_->fail({at_, unit}, what); }

 private:
  [[noreturn]] void fail_truncated() const { fail("truncated: the file ends inside the promised elements"); }
  template <class T>
  T take() {
    if (sizeof(T) > file_->bytes.size() - at_) fail_truncated();
    const T value = load_number<T>(file_->bytes.data() + at_, order_);
    at_ += sizeof(T);
    return value;
  }

  const InputFile* file_;
  std::size_t at_;
  std::endian order_;
};

/// What a property of a vertex or face means to us.
enum class Role { ignored, x, y, z, weight, corners, texture };

Role role_of(const PlyElement& element, const PlyProperty& property) {
  if ((element.name == "face" || element.name == "tristrips") && property.count && is_integer(property.type))
    return property.name == "vertex_indices" || property.name == "vertex_index" ? Role::corners
                                                                                : Role::ignored;
  if (element.name == "face" && property.count && property.name == "texcoord") return Role::texture;
  if (element.name != "vertex" || property.count) return Role::ignored;
  if (property.name == "x") return Role::x;
  if (property.name == "y") return Role::y;
  if (property.name == "z") return Role::z;
  return property.name == "weight" ? Role::weight : Role::ignored;
}

/// Whether a number is none of the vertex's place.
bool is_extra(Role role) { return role == Role::ignored || role == Role::weight; }

/// Walks the body of a file and fills a mesh and the vertices' weights.
template <class Values>
class BodyReader {
 public:
  BodyReader(const InputFile& file, const PlyHeader& header)
      : header_(header), values_(file, header), mesh_(file, Values::unit) {}

  void read() {
    for (const PlyElement& element : header_.elements) read_element(element);
    if (!values_.at_end()) values_.fail("more data than the header announces");
  }
  MeshBuilder& mesh() { return mesh_; }
  /// From here on numbers of vertices that mean nothing to us are kept.
  void keep(std::vector<VertexProperty>& properties) { kept_ = &properties; }
  /// And faces with their texture coordinates.
  void keep(std::vector<PlyFace>& faces) { faces_ = &faces; }
  const std::vector<double>& weights() const { return weights_; }

 private:
  void read_element(const PlyElement& element) {
    if (element.properties.empty()) return;
    std::vector<Role> roles;
    for (const PlyProperty& property : element.properties) roles.push_back(role_of(element, property));
    const bool keeps = kept_ && element.name == "vertex";
    if (keeps) announce(element, roles);
    for (std::size_t i = 0; i < element.count; ++i) {
      next_kept_ = keeps ? 0 : kept_none;
      const std::size_t place = values_.place();
      std::array<double, 4> vertex{};  // x, y, z, weight
      for (std::size_t k = 0; k < roles.size(); ++k) read_property(element.properties[k], roles[k], vertex);
      if (element.name == "vertex") {
        mesh_.add_vertex({vertex[0], vertex[1], vertex[2]}, place);
        weights_.push_back(vertex[3]);
      } else if (element.name == "face") {
        mesh_.add_facet(corners_, place);
        if (faces_) faces_->push_back({corners_, std::exchange(texture_, {})});
      } else if (element.name == "tristrips") {
        add_strips(place);
      }
    }
  }

  /// Each corner but a strip's first two makes a triangle with the two before it, turned over by turns; -1
  /// ends a strip. Triangles that name a vertex twice lead from one part of a strip to another and are none.
  void add_strips(std::size_t place) {
    std::size_t first = 0;  // of the strip at hand
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == -1) first = i + 1;
      if (i < first + 2) continue;
      std::array<std::int64_t, 3> triangle{corners_[i - 2], corners_[i - 1], corners_[i]};
      if ((i - first) % 2 != 0) std::swap(triangle[0], triangle[1]);
      const auto [a, b, c] = triangle;
      if (a != b && b != c && c != a) mesh_.add_facet(triangle, place);
    }
  }

  void announce(const PlyElement& element, const std::vector<Role>& roles) {
    for (std::size_t k = 0; k < roles.size(); ++k)
      if (is_extra(roles[k]) && !element.properties[k].count)
        kept_->push_back({element.properties[k].name, element.properties[k].type, {}});
  }

  void read_property(const PlyProperty& property, Role role, std::array<double, 4>& vertex) {
    if (property.count) {
      read_list(property, role);
    } else if (is_extra(role) && next_kept_ != kept_none) {
      (*kept_)[next_kept_++].values.push_back(values_.real(property.type));
    } else if (role == Role::ignored) {
      values_.skip(property.type, 1);
    } else {
      const double value = values_.real(property.type);
      if (const char* fault = coordinate_fault(value)) values_.fail(fault);
      vertex[static_cast<std::size_t>(role) - static_cast<std::size_t>(Role::x)] = value;
    }
  }

  void read_list(const PlyProperty& property, Role role) {
    const std::int64_t length = values_.integer(*property.count);
    if (length < 0) values_.fail("a list of negative length");
    if (static_cast<std::size_t>(length) > values_.room(property.type))
      values_.fail("truncated: a list of " + std::to_string(length) + " numbers");
    if (role == Role::texture && faces_) {
      for (std::int64_t i = 0; i < length; ++i) texture_.push_back(values_.real(property.type));
      return;
    }
    if (role != Role::corners) return values_.skip(property.type, static_cast<std::size_t>(length));
    corners_.resize(static_cast<std::size_t>(length));
    for (std::int64_t& corner : corners_) corner = values_.integer(property.type);
  }

  const PlyHeader& header_;
  Values values_;
  MeshBuilder mesh_;
  std::vector<double> weights_;
  std::vector<std::int64_t> corners_;
  std::vector<double> texture_;
  std::vector<PlyFace>* faces_ = nullptr;
  std::vector<VertexProperty>* kept_ = nullptr;
  static constexpr std::size_t kept_none = static_cast<std::size_t>(-1);
  std::size_t next_kept_ = kept_none;  ///< of the vertex at hand
};

void require_vertices(const InputFile& file, const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.name != "vertex") continue;
    for (const char* name : {"x", "y", "z"}) {
      const PlyProperty* property = element.find(name);
      if (!property || property->count) file.fail(std::string("the vertices have no number '") + name + "'");
    }
    return;
  }
  file.fail("no element 'vertex'");
}

void require_faces(const InputFile& file, const PlyHeader& header) {
  bool found = false;
  for (const PlyElement& element : header.elements) {
    if (element.name != "face" && element.name != "tristrips") continue;
    found = true;
    const auto names_corners = [&](const PlyProperty& p) { return role_of(element, p) == Role::corners; };
    if (std::ranges::none_of(element.properties, names_corners))
      file.fail(std::string("the ") + (element.name == "face" ? "faces" : "tristrips") +
                " have no list of integers 'vertex_indices' or 'vertex_index'");
  }
  if (!found) file.fail("no facets");
}

template <class Visit>
auto read_body(const InputFile& file, const PlyHeader& header, Visit visit) {
  const auto run = [&]<class Values>(BodyReader<Values> reader) {
    reader.read();
    return visit(reader.mesh(), reader.weights());
  };
  return header.binary ? run(BodyReader<BinaryValues>(file, header))
                       : run(BodyReader<TextValues>(file, header));
}

std::string header_text(std::size_t num_vertices, bool weights) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(num_vertices) +
                     "\nproperty double x\nproperty double y\nproperty double z\n";
  if (weights) text += "property double weight\n";
  return text;
}

void append_position(std::string& bytes, const geom::Vec3& p) {
  for (const double x : p) append_little(bytes, x);
}

}  // namespace

geom::TriMesh parse_ply(const InputFile& file, std::size_t* repeated) {
  const PlyHeader header = parse_ply_header(file);
  require_vertices(file, header);
  require_faces(file, header);
  return read_body(file, header, [repeated](MeshBuilder& mesh, const std::vector<double>&) {
    return std::move(mesh).finish(repeated);
  });
}

std::vector<geom::WeightedPoint3> parse_ply_points(const InputFile& file) {
  const PlyHeader header = parse_ply_header(file);
  require_vertices(file, header);
  return read_body(file, header, [](MeshBuilder& mesh, const std::vector<double>& weights) {
    std::vector<geom::WeightedPoint3> points;
    points.reserve(weights.size());
    for (const double weight : weights)
      points.push_back({mesh.vertices()[geom::VertexId(points.size())], weight});
    return points;
  });
}

std::vector<VertexProperty> parse_ply_properties(const InputFile& file) {
  const PlyHeader header = parse_ply_header(file);
  require_vertices(file, header);
  std::vector<VertexProperty> properties;
  const auto run = [&]<class Values>(BodyReader<Values> reader) {
    reader.keep(properties);
    reader.read();
  };
  if (header.binary)
    run(BodyReader<BinaryValues>(file, header));
  else
    run(BodyReader<TextValues>(file, header));
  return properties;
}

std::vector<PlyFace> parse_ply_faces(const InputFile& file) {
  const PlyHeader header = parse_ply_header(file);
  require_vertices(file, header);
  require_faces(file, header);
  const auto has_texture = [](const PlyElement& element) {
    return element.name == "face" &&
           std::ranges::any_of(element.properties, [&](const PlyProperty& property) {
             return role_of(element, property) == Role::texture;
           });
  };
  std::vector<PlyFace> faces;
  if (std::ranges::none_of(header.elements, has_texture)) return faces;
  const auto run = [&]<class Values>(BodyReader<Values> reader) {
    reader.keep(faces);
    reader.read();
  };
  if (header.binary)
    run(BodyReader<BinaryValues>(file, header));
  else
    run(BodyReader<TextValues>(file, header));
  return faces;
}

std::string to_ply(const geom::TriMesh& mesh) {
  std::string bytes = header_text(mesh.num_vertices(), false) + "element face " +
                      std::to_string(mesh.num_facets()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + 24 * mesh.num_vertices() + 13 * mesh.num_facets());
  for (const geom::Vec3& p : mesh.vertices()) append_position(bytes, p);
  for (const auto& facet : mesh.facets()) {
    bytes += '\3';
    for (const geom::VertexId v : facet) append_little(bytes, v.value);
  }
  return bytes;
}

std::string to_ply(const std::vector<geom::WeightedPoint3>& points) {
  const bool weights = std::any_of(points.begin(), points.end(), [](const auto& p) { return p.weight != 0; });
  std::string bytes = header_text(points.size(), weights) + "end_header\n";
  for (const geom::WeightedPoint3& p : points) {
    append_position(bytes, p.position);
    if (weights) append_little(bytes, p.weight);
  }
  return bytes;
}

}  // namespace io
