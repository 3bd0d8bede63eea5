#include "tools/report_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include "fpo/features/features.h"
#include "geom/mesh/vertex_clusters.h"
#include "tools/report_maps.h"
#include "tools/worded.h"

namespace tools {
namespace {

using fpo::CellPolygon;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;
using io::Colour;
using io::Scene;
using io::SceneTriangle;

constexpr Colour surface_colour{178, 203, 224}, pale_surface{214, 220, 226}, dot_colour{30, 60, 120},
    feature_dot_colour{200, 40, 40}, fault_colour{230, 20, 60};

/// The part of the surface that pictures show.
struct Window {
  io::SceneFrame frame;
  bool whole = true;
  bool holds(const Vec3& p) const { return whole || (p - frame.center).norm() <= frame.radius; }
};

/// The ball with the `count` samples around the one nearest to the viewer.
Window window_of(const fpo::RemeshResult& result, const Vec3& towards_viewer, std::size_t count) {
  const auto nearness = [&](const fpo::SurfaceSample& x) { return x.position.dot(towards_viewer); };
  const Vec3 center = std::ranges::max_element(result.samples, {}, nearness)->position;
  std::vector<double> distances;
  for (const fpo::SurfaceSample& x : result.samples) distances.push_back((x.position - center).norm());
  std::ranges::nth_element(distances, distances.begin() + static_cast<std::ptrdiff_t>(count - 1));
  return {{center, distances[count - 1]}, false};
}

std::string part_note(std::size_t shown, std::size_t all) {
  return "A part: " + std::to_string(shown) + " of " + std::to_string(all) + ".";
}

bool has_border(const TriMesh& mesh) {
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e)
      if (!mesh.across(t, e).valid()) return true;
  return false;
}

/// All facets that have a corner in the window.
Scene scene_of(const TriMesh& mesh, const Window& window) {
  Scene scene;
  scene.frame = window.frame;
  scene.back_faces = !window.whole || has_border(mesh);
  scene.places.assign(mesh.vertices().begin(), mesh.vertices().end());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    if (!window.holds(mesh.corner(t, 0)) && !window.holds(mesh.corner(t, 1)) &&
        !window.holds(mesh.corner(t, 2)))
      continue;
    SceneTriangle triangle{{}, mesh.normal(t)};
    for (std::size_t k = 0; k < 3; ++k)
      triangle.corners[k] = static_cast<std::uint32_t>(mesh.facet(t)[k].index());
    scene.triangles.push_back(triangle);
  }
  return scene;
}

/// The curves of features that the remesh keeps.
std::vector<std::array<Vec3, 2>> feature_lines(const RemeshPictures& of, const Window& window) {
  std::vector<std::array<Vec3, 2>> lines;
  if (!of.options.features) return lines;
  fpo::FeatureOptions options = *of.options.features;
  options.turn_scale = fpo::hexagonal_spacing(of.input.area(), of.options.num_samples) / 2;
  for (const fpo::FeatureCurve& curve : fpo::find_features(of.input, options).curves) {
    const std::size_t n = curve.vertices.size();
    for (std::size_t i = 0; i + (curve.loop ? 0 : 1) < n; ++i) {
      const Vec3 &a = of.input.position(curve.vertices[i]),
                 &b = of.input.position(curve.vertices[(i + 1) % n]);
      if (window.holds(a) && window.holds(b)) lines.push_back({a, b});
    }
  }
  return lines;
}

/// From blue for the least value to red for the largest, on a logarithmic scale.
void colour_by(Scene& scene, const fpo::VertexField& values) {
  const auto [least, most] = std::ranges::minmax(values);
  const double range = std::log(most / least);
  if (!(range > 0)) return;
  scene.palette = blue_to_red();
  const auto steps = static_cast<double>(scene.palette.size());
  for (SceneTriangle& t : scene.triangles) {
    double sum = 0;
    for (const std::uint32_t v : t.corners) sum += std::log(values[VertexId(std::size_t{v})] / least);
    t.colour = static_cast<std::uint8_t>(std::lround(sum / 3 / range * (steps - 1)));
  }
}

Scene input_scene(const RemeshPictures& of, const Window& whole, const SceneLimits& limits) {
  double width = 0;
  const TriMesh mesh = geom::with_fewer_facets(of.input, limits.input_facets, &width);
  Scene scene = scene_of(mesh, whole);
  scene.title = "Input";
  scene.note = std::to_string(of.input.num_vertices()) + " vertices, " +
               std::to_string(of.input.num_facets()) + " facets.";
  if (width > 0) {
    scene.note += " Drawn with " + std::to_string(mesh.num_facets()) + " of them.";
  } else if (of.options.sizing != fpo::SizingKind::uniform) {
    colour_by(scene, of.result.sizing);
    const auto [least, most] = std::ranges::minmax(of.wanted_lengths);
    scene.note += " Coloured by the wanted edge length.";
    if (least < most) scene.scale.colours = blue_to_red();
    for (const double share : {0.0, 0.5, 1.0})
      scene.scale.labels.push_back(worded("%.4g", std::pow(least, 1 - share) * std::pow(most, share)));
  }
  scene.lines = feature_lines(of, whole);
  if (!scene.lines.empty()) scene.note += " Features in red.";
  return scene;
}

Scene sample_scene(const RemeshPictures& of, const Window& window, const SceneLimits& limits) {
  const TriMesh mesh = geom::with_fewer_facets(of.input, limits.input_facets);
  Scene scene = scene_of(mesh, window);
  for (SceneTriangle& t : scene.triangles) t.edges = 0;
  scene.title = "Samples";
  scene.palette = {pale_surface, dot_colour, feature_dot_colour};
  const std::vector<fpo::SurfaceSample>& samples = of.result.samples;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (window.holds(samples[i].position))
      scene.dots.push_back(
          {samples[i].position, static_cast<std::uint8_t>(i < of.result.feature_samples ? 2 : 1)});
  scene.note =
      window.whole ? std::to_string(samples.size()) + "." : part_note(scene.dots.size(), samples.size());
  if (of.result.feature_samples > 0)
    scene.note += " " + std::to_string(of.result.feature_samples) + " of them (red) on features or fixed.";
  scene.lines = feature_lines(of, window);
  return scene;
}

/// Corners of polygons, equal ones (to the last bit) once.
class PlaceTable {
 public:
  std::uint32_t number_of(const Vec3& p) {
    const auto [entry, is_new] =
        numbers_.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(places_.size()));
    if (is_new) places_.push_back(p);
    return entry->second;
  }
  std::vector<Vec3> take() { return std::move(places_); }

 private:
  std::map<std::tuple<double, double, double>, std::uint32_t> numbers_;
  std::vector<Vec3> places_;
};

/// Which edges of the polygons lie between cells, or on the border: those that no second polygon of the same
/// cell has. By polygon, then edge.
std::vector<std::vector<bool>> cell_borders(const std::vector<const CellPolygon*>& polygons,
                                            const std::vector<std::vector<std::uint32_t>>& corners) {
  struct Side {
    geom::SiteId site;
    std::uint32_t low, high;
    std::size_t polygon, edge;
    auto key() const { return std::tie(site, low, high); }
  };
  std::vector<Side> sides;
  std::vector<std::vector<bool>> result;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::vector<std::uint32_t>& c = corners[i];
    result.emplace_back(c.size(), false);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const auto [low, high] = std::minmax(c[k], c[(k + 1) % c.size()]);
      sides.push_back({polygons[i]->site, low, high, i, k});
    }
  }
  std::ranges::sort(sides, {}, &Side::key);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool alone = (i == 0 || sides[i - 1].key() != sides[i].key()) &&
                       (i + 1 == sides.size() || sides[i + 1].key() != sides[i].key());
    result[sides[i].polygon][sides[i].edge] = alone;
  }
  return result;
}

/// Colours of cells with 6, 5, 7, fewer and more neighbours.
const std::vector<Colour> valence_palette = {
    {222, 226, 231}, {120, 170, 225}, {240, 178, 96}, {84, 84, 190}, {212, 74, 66}};

std::vector<std::uint8_t> valence_colours(const TriMesh& remesh) {
  std::vector<std::vector<std::size_t>> neighbours(remesh.num_vertices());
  for (const TriMesh::Facet& f : remesh.facets())
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours[f[k].index()].push_back(f[(k + 1) % 3].index());
      neighbours[f[(k + 1) % 3].index()].push_back(f[k].index());
    }
  std::vector<std::uint8_t> colours;
  for (std::vector<std::size_t>& list : neighbours) {
    std::ranges::sort(list);
    const auto valence = std::unique(list.begin(), list.end()) - list.begin();
    colours.push_back(valence == 6 ? 0 : valence == 5 ? 1 : valence == 7 ? 2 : valence < 5 ? 3 : 4);
  }
  return colours;
}

/// The polygons of the cells in the window; if they have too many corners, of a smaller window.
std::vector<const CellPolygon*> polygons_in(const RemeshPictures& of, const SceneLimits& limits,
                                            Window& window, const Vec3& towards_viewer) {
  for (std::size_t samples = of.result.samples.size();; samples = (samples + 1) / 2) {
    std::vector<const CellPolygon*> polygons;
    std::size_t corners = 0;
    for (const CellPolygon& polygon : of.result.cells) {
      if (!window.holds(of.result.samples[polygon.site.index()].position)) continue;
      polygons.push_back(&polygon);
      corners += polygon.corners.size();
    }
    if (corners <= limits.cell_corners || samples == 1) return polygons;
    window = window_of(of.result, towards_viewer, (samples + 1) / 2);
  }
}

void add_polygon(Scene& scene, const std::vector<std::uint32_t>& corners, const std::vector<bool>& borders,
                 const SceneTriangle& like) {
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    SceneTriangle t = like;
    t.corners = {corners[0], corners[k], corners[k + 1]};
    const bool first = k == 1 && borders[0], last = k + 2 == corners.size() && borders[k + 1];
    t.edges = static_cast<std::uint8_t>((first ? 1 : 0) + (borders[k] ? 2 : 0) + (last ? 4 : 0));
    scene.triangles.push_back(t);
  }
}

Scene cell_scene(const RemeshPictures& of, Window window, const SceneLimits& limits,
                 const Vec3& towards_viewer) {
  const std::vector<const CellPolygon*> polygons = polygons_in(of, limits, window, towards_viewer);
  Scene scene;
  scene.frame = window.frame;
  scene.title = "Power diagram";
  scene.palette = valence_palette;
  scene.back_faces = !window.whole || has_border(of.input);
  scene.note = "Coloured by the number of neighbours: 6 gray, 5 blue, 7 orange, fewer violet, more red.";
  if (!window.whole) {
    const auto cells =
        std::ranges::count_if(of.result.samples, [&](const auto& x) { return window.holds(x.position); });
    scene.note += " " + part_note(static_cast<std::size_t>(cells), of.result.samples.size());
  }
  PlaceTable places;
  std::vector<std::vector<std::uint32_t>> corners;
  for (const CellPolygon* polygon : polygons) {
    std::vector<std::uint32_t>& numbers = corners.emplace_back();
    for (const Vec3& p : polygon->corners) numbers.push_back(places.number_of(p));
  }
  const std::vector<std::vector<bool>> borders = cell_borders(polygons, corners);
  const std::vector<std::uint8_t> colours = valence_colours(of.result.mesh);
  for (std::size_t i = 0; i < polygons.size(); ++i)
    add_polygon(scene, corners[i], borders[i],
                {{}, of.input.normal(polygons[i]->facet), 0, colours[polygons[i]->site.index()]});
  scene.places = places.take();
  scene.edge_spacing = fpo::hexagonal_spacing(of.input.area(), of.result.samples.size());
  return scene;
}

/// Edges of the remesh on borders and where it is folded by more than 20 degrees, between samples on
/// features.
std::vector<std::array<Vec3, 2>> sharp_edges(const RemeshPictures& of, const Window& window) {
  const double least_cosine = std::cos(20 * std::numbers::pi / 180);
  const TriMesh& mesh = of.result.mesh;
  std::vector<std::array<Vec3, 2>> lines;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    for (int e = 0; e < 3; ++e) {
      const auto k = static_cast<std::size_t>(e);
      const VertexId a = mesh.facet(t)[k], b = mesh.facet(t)[(k + 1) % 3];
      if (std::max(a, b).index() >= of.result.feature_samples) continue;
      const FacetId other = mesh.across(t, e);
      if (other.valid() &&
          (other < t || mesh.normal(t).normalized().dot(mesh.normal(other).normalized()) > least_cosine))
        continue;
      if (window.holds(mesh.position(a)) && window.holds(mesh.position(b)))
        lines.push_back({mesh.position(a), mesh.position(b)});
    }
  }
  return lines;
}

Scene remesh_scene(const RemeshPictures& of, const Window& window) {
  Scene scene = scene_of(of.result.mesh, window);
  scene.title = "Remesh";
  scene.note = std::to_string(of.result.mesh.num_vertices()) + " vertices, " +
               std::to_string(of.result.mesh.num_facets()) + " triangles.";
  if (!window.whole) scene.note += " " + part_note(scene.triangles.size(), of.result.mesh.num_facets());
  scene.palette = {surface_colour, fault_colour};
  scene.lines = sharp_edges(of, window);
  for (const Vec3& place : of.result.advice.places)
    if (window.holds(place)) scene.dots.push_back({place, 1});
  if (!scene.dots.empty()) scene.note += " Dots: where it is of another topological type than the input.";
  return scene;
}

}  // namespace

std::vector<Scene> remesh_scenes(const RemeshPictures& of, const io::SceneView& view,
                                 const SceneLimits& limits) {
  std::vector<Vec3> places;  // of referenced vertices: a mesh may have others far away
  for (const TriMesh::Facet& f : of.input.facets())
    for (const VertexId v : f) places.push_back(of.input.position(v));
  const Window whole{io::frame_of(places), true};
  const Window window = of.result.samples.size() <= limits.samples
                            ? whole
                            : window_of(of.result, view.towards_viewer, limits.samples / 2);
  std::vector<Scene> scenes = {input_scene(of, whole, limits), sample_scene(of, window, limits),
                               cell_scene(of, window, limits, view.towards_viewer), remesh_scene(of, window)};
  for (Scene& map : remesh_maps(scenes.back(), of.result.mesh, {of.input, of.unit, of.options.threads}))
    scenes.push_back(std::move(map));
  return scenes;
}

}  // namespace tools
