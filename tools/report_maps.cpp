#include "tools/report_maps.h"

#include <algorithm>
#include <cmath>

#include "fpo/measure/deviation.h"
#include "fpo/measure/triangle_angles.h"
#include "geom/check.h"
#include "geom/ids.h"
#include "tools/worded.h"

namespace tools {
namespace {

using geom::FacetId;
using geom::TriMesh;
using io::Colour;
using io::Scene;
using io::SceneTriangle;

constexpr std::size_t steps = 32;
constexpr double least_angle = 30, largest_angle = 60;
constexpr double rounding = 1e-9;  // of diagonals: less is no distance

std::string number(double value, const char* format) { return worded(format, value); }

std::uint8_t mixed(double s, int from, int to) {
  return static_cast<std::uint8_t>(std::lround(from + s * (to - from)));
}

/// From pale to dark red.
std::vector<Colour> pale_to_red() {
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < steps; ++i) {
    const double s = static_cast<double>(i) / (steps - 1);
    const double first = std::min(1.0, 2 * s), second = std::max(0.0, 2 * s - 1);
    colours.push_back({mixed(second, mixed(first, 238, 240), 140), mixed(second, mixed(first, 240, 140), 16),
                       mixed(second, mixed(first, 240, 70), 24)});
  }
  return colours;
}

std::uint8_t step_of(double share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * (steps - 1)));
}

/// The smallest angle, degrees.
double smallest_angle(const TriMesh& mesh, FacetId t) {
  return std::min(180.0, std::ranges::min(fpo::angles_of(mesh, t)));
}

/// The facets that a picture shows.
std::vector<FacetId> facets_of(const Scene& picture, const TriMesh& mesh) {
  std::vector<FacetId> facets;
  FacetId t(0);
  const auto shows = [&](const SceneTriangle& triangle) {
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.facet(t)[k].index() != triangle.corners[k]) return false;
    return true;
  };
  for (const SceneTriangle& triangle : picture.triangles) {
    while (t.index() < mesh.num_facets() && !shows(triangle)) t = FacetId(t.value + 1);
    geom::ensure(t.index() < mesh.num_facets(), "a picture's triangle is no facet of the mesh");
    facets.push_back(t);
    t = FacetId(t.value + 1);
  }
  return facets;
}

Scene map_like(const Scene& picture, const char* title, std::vector<Colour> colours) {
  Scene map = picture;
  map.title = title;
  map.dots.clear();
  for (SceneTriangle& triangle : map.triangles) triangle.edges = 0;  // which would darken the colours
  map.palette = map.scale.colours = std::move(colours);
  return map;
}

Scene distance_map(const Scene& picture, const std::vector<FacetId>& facets, const TriMesh& mesh,
                   const MapSource& source) {
  const geom::Table<FacetId, double> distances = fpo::facet_deviations(mesh, source.input, source.threads);
  const double found = *std::ranges::max_element(distances), diagonal = source.input.diagonal();
  const double most = std::max(found, rounding * diagonal);
  Scene map = map_like(picture, "Distance", pale_to_red());
  for (std::size_t i = 0; i < facets.size(); ++i)
    map.triangles[i].colour = step_of(distances[facets[i]] / most);
  map.note = "How far each triangle and the input are apart, by some points of both: at most " +
             number(found * source.unit, "%.4g") + ", " + number(100 * found / diagonal, "%.2g") +
             " % of the diagonal.";
  for (const double share : {0.0, 0.5, 1.0})
    map.scale.labels.push_back(number(share * most * source.unit, "%.3g"));
  return map;
}

Scene angle_map(const Scene& picture, const std::vector<FacetId>& facets, const TriMesh& mesh) {
  std::vector<Colour> colours = blue_to_red();
  std::ranges::reverse(colours);
  Scene map = map_like(picture, "Smallest angles", std::move(colours));
  double smallest = 180;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const double angle = smallest_angle(mesh, facets[i]);
    smallest = std::min(smallest, angle);
    map.triangles[i].colour = step_of((angle - least_angle) / (largest_angle - least_angle));
  }
  map.note = "Of each triangle; the smallest here has " + number(smallest, "%.1f") + " degrees.";
  map.scale.labels = {"30\u00b0 or less", "45\u00b0", "60\u00b0"};
  return map;
}

}  // namespace

std::vector<Colour> blue_to_red() {
  std::vector<Colour> colours;
  for (std::size_t i = 0; i < steps; ++i) {
    const double s = 2.0 * static_cast<double>(i) / (steps - 1) - 1;  // -1 to 1
    const auto mix = [s](int low, int high) { return mixed(std::abs(s), 225, s < 0 ? low : high); };
    colours.push_back({mix(59, 196), mix(92, 48), mix(196, 43)});
  }
  return colours;
}

std::vector<Scene> remesh_maps(const Scene& picture, const TriMesh& mesh, const MapSource& source) {
  if (picture.triangles.empty()) return {};
  const std::vector<FacetId> facets = facets_of(picture, mesh);
  return {distance_map(picture, facets, mesh, source), angle_map(picture, facets, mesh)};
}

}  // namespace tools
