#include "tools/remesh_carry.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"
#include "io/atomic_file.h"
#include "io/attributed_mesh.h"
#include "io/attributes.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "tools/interrupt.h"
#include "tools/own_vertices.h"

namespace tools {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec2;
using geom::Vec3;
using geom::VertexId;

namespace {

using Corners = std::array<std::int32_t, 3>;
constexpr std::int32_t no_chart = -1;

/// Texture coordinates of the facets of a surface, in charts: parts that share coordinates by their numbers.
struct TexturedSurface {
  geom::Table<FacetId, Corners> texture;     ///< of each facet's corners; -1: none
  geom::Table<FacetId, std::int32_t> chart;  ///< of each facet
};

std::vector<std::int32_t> charts_of(const io::Attributes& attributes) {
  std::vector<std::int32_t> parent(attributes.texture.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<std::int32_t>(i);
  const auto root = [&](std::int32_t i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  for (const io::AttributedTriangle& t : attributes.triangles)
    for (std::size_t i = 1; i < 3; ++i)
      if (t.texture[0] >= 0 && t.texture[i] >= 0) {
        const std::int32_t a = root(t.texture[0]), b = root(t.texture[i]);
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      }
  for (std::int32_t& p : parent) p = root(p);
  return parent;
}

TexturedSurface textured(const TriMesh& mesh, const io::Attributes& attributes) {
  const auto first = own_vertices(attributes.vertices, attributes.vertices);
  const auto own = own_vertices(mesh.vertices(), attributes.vertices);
  std::map<std::array<VertexId, 3>, std::array<std::pair<VertexId, std::int32_t>, 3>> known;
  for (const io::AttributedTriangle& t : attributes.triangles) {
    std::array<std::pair<VertexId, std::int32_t>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {first[t.vertices[i]], t.texture[i]};
    std::ranges::sort(corners);
    known.try_emplace({corners[0].first, corners[1].first, corners[2].first}, corners);
  }
  const std::vector<std::int32_t> chart = charts_of(attributes);
  TexturedSurface result;
  for (const TriMesh::Facet& f : mesh.facets()) {
    std::array<VertexId, 3> key{own[f[0]], own[f[1]], own[f[2]]};
    Corners texture{-1, -1, -1};
    std::array<VertexId, 3> sorted = key;
    std::ranges::sort(sorted);
    if (const auto at = known.find(sorted); at != known.end())
      for (std::size_t i = 0; i < 3; ++i)
        for (const auto& [v, t] : at->second)
          if (v == key[i]) texture[i] = t;
    const bool whole = std::ranges::min(texture) >= 0;
    result.texture.push_back(texture);
    result.chart.push_back(whole ? chart[static_cast<std::size_t>(texture[0])] : no_chart);
  }
  return result;
}

/// Texture coordinates for a remesh.
class TextureTransfer {
 public:
  TextureTransfer(const TriMesh& input, const io::Attributes& attributes)
      : factor_(geom::factor_to_unit_box(input)),
        mesh_(geom::scaled(input, factor_)),
        attributes_(attributes),
        source_(textured(input, attributes)),
        tree_(mesh_) {}

  void transfer(const TriMesh& remesh) {
    for (const TriMesh::Facet& f : remesh.facets()) {
      Vec3 middle(0, 0, 0);
      for (const VertexId v : f) middle += factor_ * remesh.position(v) / 3;
      const std::int32_t chart = source_.chart[tree_.closest(middle).facet];
      Corners& corners = result.emplace_back(Corners{-1, -1, -1});
      if (chart == no_chart) continue;
      bool crossing = false;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = coordinate(f[i], chart, factor_ * remesh.position(f[i]), crossing);
      crossings += crossing;
    }
  }

  std::vector<Corners> result;
  std::vector<Vec2> texture;
  std::size_t crossings = 0;  ///< triangles of which a corner lies beyond their chart

 private:
  /// A part of the surface with the facets' ids there.
  struct Chart {
    std::vector<FacetId> facets;
    geom::AabbTree tree;
  };

  const Chart& chart_at(std::int32_t chart) {
    const auto known = charts_.find(chart);
    if (known != charts_.end()) return known->second;
    std::vector<FacetId> facets;
    geom::Table<FacetId, TriMesh::Facet> corners;
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
      if (source_.chart[t] == chart) facets.push_back(t), corners.push_back(mesh_.facet(t));
    geom::AabbTree tree(TriMesh(mesh_.vertices(), std::move(corners)));
    return charts_.emplace(chart, Chart{std::move(facets), std::move(tree)}).first->second;
  }

  /// The number of the texture coordinate of a vertex in a chart.
  std::int32_t coordinate(VertexId v, std::int32_t chart, const Vec3& x, bool& crossing) {
    constexpr double on_chart = 1e-6;  // of about the diagonal
    const auto known = numbers_.find({v, chart});
    if (known != numbers_.end()) return crossing |= known->second.second, known->second.first;
    const Chart& part = chart_at(chart);
    const geom::AabbTree::Closest closest = part.tree.closest(x);
    const Corners& corners = source_.texture[part.facets[closest.facet.index()]];
    Vec2 at(0, 0);
    for (int i = 0; i < 3; ++i)
      at += closest.barycentric[i] *
            attributes_.texture[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])];
    const bool beyond = closest.distance2 > on_chart * on_chart;
    const auto number = static_cast<std::int32_t>(texture.size());
    texture.push_back(at);
    numbers_[{v, chart}] = {number, beyond};
    return crossing |= beyond, number;
  }

  double factor_;
  TriMesh mesh_;
  const io::Attributes& attributes_;
  TexturedSurface source_;
  geom::AabbTree tree_;
  std::map<std::int32_t, Chart> charts_;
  std::map<std::pair<VertexId, std::int32_t>, std::pair<std::int32_t, bool>> numbers_;
};

std::vector<io::VertexProperty> carried(const io::Attributes& attributes,
                                        const std::vector<io::MappedPoint>& places) {
  std::vector<io::VertexProperty> result;
  for (const io::VertexProperty& p : attributes.properties) {
    io::VertexProperty& out = result.emplace_back(io::VertexProperty{p.name, p.type, {}});
    for (const io::MappedPoint& place : places) {
      double value = 0;
      for (int i = 0; i < 3; ++i)
        if (place.barycentric[i] > 0)
          value += place.barycentric[i] * p.values[place.vertices[static_cast<std::size_t>(i)].index()];
      out.values.push_back(value);
    }
  }
  return result;
}

bool is_colour(const io::VertexProperty& p) {
  return p.name == "red" || p.name == "green" || p.name == "blue";
}

/// OBJ colours go from 0 to 1, those of PLY are bytes as a rule.
void make_bytes(std::vector<io::VertexProperty>& properties) {
  for (io::VertexProperty& p : properties)
    if (is_colour(p) && !io::is_integer(p.type)) {
      p.type = io::PlyType::uint8;
      for (double& value : p.values) value *= 255;
    }
}

/// What the input has and a remesh of that format, carried or not, has not.
std::string dropped_in_words(const io::Attributes& attributes, bool carry, io::MeshFormat format) {
  const bool ply = carry && format == io::MeshFormat::ply, obj = carry && format == io::MeshFormat::obj;
  const auto& properties = attributes.properties;
  std::string words;
  const auto add = [&](bool wanted, const char* word) {
    if (wanted) words += (words.empty() ? "" : ", ") + std::string(word);
  };
  add(std::ranges::any_of(properties, is_colour) && !ply && !obj, "vertex colours");
  add(std::ranges::any_of(properties, [](const auto& p) { return !is_colour(p); }) && !ply,
      "vertex properties");
  add(!attributes.texture.empty() && !ply && !obj, "texture coordinates");
  add(attributes.parts, "groups and materials");
  add(!attributes.lines.empty(), "lines");
  add(attributes.dropped, "numbers of faces");
  if (words.empty()) return words;
  return words + (carry ? "" : " (--carry keeps colours, properties and texture coordinates)");
}

}  // namespace

void write_map(const RemeshArguments& a, const TriMesh& input, const fpo::RemeshResult& result) {
  std::size_t elsewhere = 0;
  io::write_surface_map(a.map, own_places(a.input, input, result.samples, elsewhere));
  if (elsewhere > 0)
    std::fprintf(stderr,
                 "note: %zu vertices lie on what the repair has made: the map has the nearest place\n",
                 elsewhere);
}

void write_remesh(const RemeshArguments& a, const TriMesh& input, const fpo::RemeshResult& result,
                  std::string& dropped) {
  if (!a.carry && interrupt_flag()) return io::write_mesh(a.output, result.mesh);  // without a second look
  const io::MeshFormat format = io::mesh_format(a.output);
  const io::Attributes attributes = io::read_attributes(a.input);
  dropped = dropped_in_words(attributes, a.carry, format);
  if (!a.carry || (format != io::MeshFormat::obj && format != io::MeshFormat::ply))
    return io::write_mesh(a.output, result.mesh);
  std::size_t elsewhere = 0;
  std::vector<io::VertexProperty> properties =
      carried(attributes, own_places(a.input, input, result.samples, elsewhere));
  if (format == io::MeshFormat::ply) make_bytes(properties);
  std::optional<TextureTransfer> textures;
  if (!attributes.texture.empty()) textures.emplace(input, attributes).transfer(result.mesh);
  io::AttributedMesh out{result.mesh.vertices(), result.mesh.facets(), properties};
  if (textures) out.texture = textures->texture, out.corner_texture = textures->result;
  io::write_file(a.output, format == io::MeshFormat::ply ? io::to_ply(out) : io::to_obj(out));
  if (textures && textures->crossings > 0)
    std::fprintf(stderr,
                 "note: %zu triangles cross a seam of the texture coordinates (--features auto,seams "
                 "keeps it)\n",
                 textures->crossings);
}

}  // namespace tools
