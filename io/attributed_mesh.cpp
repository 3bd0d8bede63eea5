#include "io/attributed_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/byte_order.h"
#include "io/numbers.h"

namespace io {
namespace {

const char* name_of(PlyType type) {
  using enum PlyType;
  switch (type) {
    case int8:
      return "char";
    case uint8:
      return "uchar";
    case int16:
      return "short";
    case uint16:
      return "ushort";
    case int32:
      return "int";
    case uint32:
      return "uint";
    case float32:
      return "float";
    case float64:
      return "double";
  }
  return "";
}

template <class Integer>
void append_as(std::string& bytes, double value) {
  using Limits = std::numeric_limits<Integer>;
  const double inside = std::isnan(value) ? 0
                                          : std::clamp(std::round(value), static_cast<double>(Limits::min()),
                                                       static_cast<double>(Limits::max()));
  append_little(bytes, static_cast<Integer>(inside));
}

void append_value(std::string& bytes, PlyType type, double value) {
  using enum PlyType;
  switch (type) {
    case int8:
      return append_as<std::int8_t>(bytes, value);
    case uint8:
      return append_as<std::uint8_t>(bytes, value);
    case int16:
      return append_as<std::int16_t>(bytes, value);
    case uint16:
      return append_as<std::uint16_t>(bytes, value);
    case int32:
      return append_as<std::int32_t>(bytes, value);
    case uint32:
      return append_as<std::uint32_t>(bytes, value);
    case float32:
      return append_little(bytes, static_cast<float>(value));
    case float64:
      return append_little(bytes, value);
  }
}

/// Red, green and blue, if all are there.
std::vector<const VertexProperty*> colours_of(const AttributedMesh& mesh) {
  std::vector<const VertexProperty*> colours;
  for (const char* name : {"red", "green", "blue"})
    for (const VertexProperty& p : mesh.properties)
      if (p.name == name) colours.push_back(&p);
  return colours.size() == 3 ? colours : std::vector<const VertexProperty*>();
}

std::string ply_header(const AttributedMesh& mesh) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string(mesh.vertices.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\n";
  for (const VertexProperty& p : mesh.properties)
    text += std::string("property ") + name_of(p.type) + " " + p.name + "\n";
  if (!mesh.facets.empty())
    text +=
        "element face " + std::to_string(mesh.facets.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!mesh.corner_texture.empty()) text += "property list uchar float texcoord\n";
  return text + "end_header\n";
}

void append_texture(std::string& bytes, const AttributedMesh& mesh, std::size_t facet) {
  append_little(bytes, std::uint8_t{6});
  for (const std::int32_t i : mesh.corner_texture[facet]) {
    const geom::Vec2 at = i < 0 ? geom::Vec2(0, 0) : mesh.texture[static_cast<std::size_t>(i)];
    for (const double t : at) append_little(bytes, static_cast<float>(t));
  }
}

}  // namespace

std::string to_ply(const AttributedMesh& mesh) {
  std::string bytes = ply_header(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (const double x : mesh.vertices[geom::VertexId(v)]) append_little(bytes, x);
    for (const VertexProperty& p : mesh.properties) append_value(bytes, p.type, p.values[v]);
  }
  for (std::size_t t = 0; t < mesh.facets.size(); ++t) {
    append_little(bytes, std::uint8_t{3});
    for (const geom::VertexId v : mesh.facets[t]) append_little(bytes, v.value);
    if (!mesh.corner_texture.empty()) append_texture(bytes, mesh, t);
  }
  return bytes;
}

std::string to_obj(const AttributedMesh& mesh) {
  const std::vector<const VertexProperty*> colours = colours_of(mesh);
  std::string text;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    text += 'v';
    for (const double x : mesh.vertices[geom::VertexId(v)]) append_shortest(text += ' ', x);
    for (const VertexProperty* p : colours)
      append_shortest(text += ' ', is_integer(p->type) ? p->values[v] / 255 : p->values[v]);
    text += '\n';
  }
  for (const geom::Vec2& at : mesh.texture) {
    text += "vt";
    for (const double t : at) append_shortest(text += ' ', t);
    text += '\n';
  }
  for (std::size_t t = 0; t < mesh.facets.size(); ++t) {
    text += 'f';
    for (std::size_t i = 0; i < 3; ++i) {
      append_integer(text += ' ', mesh.facets[t][i].value + 1);
      const std::int32_t texture = mesh.corner_texture.empty() ? -1 : mesh.corner_texture[t][i];
      if (texture >= 0) append_integer(text += '/', texture + 1);
    }
    text += '\n';
  }
  return text;
}

}  // namespace io
