#include "tools/remesh_sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "fpo/remesh/lengths.h"
#include "io/attributes.h"
#include "io/extension.h"
#include "io/gray_image.h"
#include "io/input_file.h"
#include "io/values.h"
#include "tools/own_vertices.h"

namespace tools {
namespace {

constexpr double least_density = 0.01;  // as of images in the plane (image_sizing.h)
constexpr double infinite = std::numeric_limits<double>::infinity();

std::string listed(const std::vector<io::VertexProperty>& properties) {
  std::string names;
  for (const io::VertexProperty& p : properties) names += (names.empty() ? "" : ", ") + p.name;
  return names.empty() ? "it has none" : "it has " + names;
}

/// The property named, or those that --sizing-out and others write.
const io::VertexProperty& chosen(const std::vector<io::VertexProperty>& properties,
                                 const RemeshArguments& a) {
  const std::vector<std::string> wanted = a.sizing_property.empty()
                                              ? std::vector<std::string>{"value", "size", "density"}
                                              : std::vector<std::string>{a.sizing_property};
  for (const std::string& name : wanted)
    for (const io::VertexProperty& p : properties)
      if (p.name == name) return p;
  throw geom::InputError(io::display_name(a.sizing_file) + ": no vertex property '" + wanted.front() + "' (" +
                         listed(properties) + "; --sizing FILE:PROPERTY names one)");
}

fpo::VertexField property_lengths(const RemeshArguments& a, std::size_t count) {
  const io::InputFile file = io::load(a.sizing_file);
  const std::vector<io::VertexProperty> properties = io::parse_ply_properties(file);
  const io::VertexProperty& p = chosen(properties, a);
  if (p.values.size() != count)
    file.fail(std::to_string(p.values.size()) + " vertices where " + std::to_string(count) + " are wanted");
  fpo::VertexField lengths;
  for (std::size_t v = 0; v < count; ++v) {
    const double value = p.values[v];
    if (!(value > 0) || value == infinite)
      file.fail("property '" + p.name + "' of vertex " + std::to_string(v) + " is not a positive number");
    lengths.push_back(p.name == "density" ? std::sqrt(2 / (std::sqrt(3.0) * value)) : value);
  }
  return lengths;
}

/// Bilinear between the centers of pixels, repeated beyond [0, 1); v points up.
double gray_at(const io::GrayImage& image, const geom::Vec2& texture) {
  const auto along = [](double t, std::size_t count) {
    const double x = (t - std::floor(t)) * static_cast<double>(count) - 0.5;
    const auto low = static_cast<std::int64_t>(std::floor(x));
    const auto n = static_cast<std::int64_t>(count);
    return std::tuple(static_cast<std::size_t>((low + n) % n), static_cast<std::size_t>((low + 1) % n),
                      x - std::floor(x));
  };
  const auto [i0, i1, s] = along(texture.x(), image.width);
  const auto [j0, j1, t] = along(1 - texture.y(), image.height);
  const auto value = [&](std::size_t i, std::size_t j) {
    return static_cast<double>(image.value[j * image.width + i]);
  };
  return (1 - t) * ((1 - s) * value(i0, j0) + s * value(i1, j0)) +
         t * ((1 - s) * value(i0, j1) + s * value(i1, j1));
}

/// Where a vertex has several texture coordinates the darkest counts; who has none is white.
fpo::VertexField image_lengths(const RemeshArguments& a, const geom::TriMesh& mesh) {
  const io::Attributes attributes = io::read_attributes(a.input);
  geom::require(!attributes.texture.empty(),
                io::display_name(a.input) +
                    ": no texture coordinates (vt of OBJ, texcoord of PLY), by which " +
                    io::display_name(a.sizing_file) + " could be seen");
  const io::GrayImage image = io::read_gray_image(a.sizing_file);
  geom::Table<geom::VertexId, double> density(attributes.vertices.size(), least_density);
  for (const io::AttributedTriangle& t : attributes.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      if (t.texture[i] < 0) continue;
      const geom::Vec2& at = attributes.texture[static_cast<std::size_t>(t.texture[i])];
      double& most = density[t.vertices[i]];
      most = std::max(most, 1 - gray_at(image, at));
    }
  fpo::VertexField lengths;
  for (const geom::VertexId v : own_vertices(mesh.vertices(), attributes.vertices))
    lengths.push_back(v.valid() ? 1 / std::sqrt(density[v]) : infinite);
  return lengths;
}

fpo::VertexField file_lengths(const RemeshArguments& a, const geom::TriMesh& mesh) {
  if (io::is_image(a.sizing_file)) return image_lengths(a, mesh);
  if (io::lower_extension(a.sizing_file) == ".ply") return property_lengths(a, mesh.num_vertices());
  const std::vector<double> values = io::read_positive_values(a.sizing_file, mesh.num_vertices());
  return {values.begin(), values.end()};
}

/// An image says nothing of lengths: its ratios are scaled so that the shortest edge is the one asked for.
void scale_to_shortest(fpo::VertexField& lengths, double shortest) {
  const double least = *std::ranges::min_element(lengths);
  for (double& length : lengths) length *= shortest / least;
}

}  // namespace

void set_sizing(RemeshArguments& a, const std::string& text) {
  a.sizing_property.clear();
  a.sizing_file.clear();
  for (const fpo::SizingFacts& facts : fpo::sizings())
    if (facts.name && text == facts.name) {
      a.remesh.sizing = facts.kind;
      return;
    }
  a.remesh.sizing = fpo::SizingKind::given;
  const std::size_t colon = text.rfind(':');
  std::error_code unknown;
  const bool names_property = colon != std::string::npos && !std::filesystem::exists(text, unknown);
  a.sizing_file = names_property ? text.substr(0, colon) : text;
  if (names_property) a.sizing_property = text.substr(colon + 1);
  geom::require(!a.sizing_file.empty(), "a file name cannot be empty");
  geom::require(!names_property || io::lower_extension(a.sizing_file) == ".ply",
                "FILE:PROPERTY is for .ply files");
}

void settle_sizing(RemeshArguments& a, SurfaceInput& input) {
  const bool by_count = a.remesh.num_samples > 0, by_file = a.remesh.sizing == fpo::SizingKind::given;
  if (by_file) a.remesh.rho = file_lengths(a, input.mesh);
  const std::string file = io::display_name(a.sizing_file);
  if (by_count && by_file)
    input.notes.push_back("sizing: " + file + ": only ratios count, for -n says how many samples there are");
  if (!by_count) {
    if (by_file && io::is_image(a.sizing_file)) {
      geom::require(a.lengths.edge_length.has_value(),
                    file + ": an image has no lengths: say -n COUNT, or --edge-length of its darkest places");
      scale_to_shortest(a.remesh.rho, *a.lengths.edge_length / fpo::mean_edge_over_wanted);
      a.lengths.edge_length.reset();
    }
    fpo::set_number_of_samples(input.mesh, a.lengths, a.remesh);
    const std::string samples = std::to_string(a.remesh.num_samples) + " samples";
    if (by_file) input.notes.push_back("sizing: " + file + ": lengths as they are, which takes " + samples);
  }
  fpo::complete(a.remesh, a.choices);
}

}  // namespace tools
