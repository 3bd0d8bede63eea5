#include "fpo/measure/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "fpo/measure/triangle_angles.h"
#include "geom/check.h"
#include "geom/mesh/edges.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr double rounding = 1e-9;  // an angle of 30 degrees is not below 30, however it is rounded

struct FacetQuality {
  double q;
  std::array<double, 3> angles;
};

FacetQuality facet_quality(const TriMesh& mesh, FacetId t) {
  FacetQuality result{0, angles_of(mesh, t)};
  double perimeter = 0, longest = 0;
  for (int i = 0; i < 3; ++i) {
    const double length = (mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i)).norm();
    perimeter += length;
    longest = std::max(longest, length);
  }
  if (longest > 0) result.q = 6 / std::numbers::sqrt3 * mesh.area(t) / (perimeter / 2 * longest);
  return result;
}

/// What the edges say of each vertex.
struct VertexStar {
  std::size_t edges = 0;
  bool on_boundary = false;
  double shortest = std::numeric_limits<double>::infinity();
};

std::vector<VertexStar> vertex_stars(const TriMesh& mesh, double& mean_edge) {
  std::vector<VertexStar> stars(mesh.num_vertices());
  double sum = 0, edges = 0;
  geom::for_each_edge(mesh.facets(), [&](auto first, auto last) {
    const double length = (mesh.position(first->low) - mesh.position(first->high)).norm();
    for (const VertexId v : {first->low, first->high}) {
      VertexStar& star = stars[v.index()];
      ++star.edges;
      star.on_boundary |= last - first == 1;
      star.shortest = std::min(star.shortest, length);
    }
    sum += length, ++edges;
  });
  mean_edge = sum / edges;
  return stars;
}

}  // namespace

Quality quality(const TriMesh& mesh, double area) {
  geom::require(mesh.num_facets() > 0, "the mesh has no facet");
  Quality result;
  result.q_min = result.theta_min = std::numeric_limits<double>::infinity();
  std::size_t below_30 = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const FacetQuality f = facet_quality(mesh, t);
    const auto [smallest, largest] = std::ranges::minmax(f.angles);
    result.q_min = std::min(result.q_min, f.q);
    result.q_avg += f.q;
    result.theta_min = std::min(result.theta_min, smallest);
    result.theta_max = std::max(result.theta_max, largest);
    result.theta_min_avg += smallest;
    below_30 +=
        static_cast<std::size_t>(std::ranges::count_if(f.angles, [](double a) { return a < 30 - rounding; }));
  }
  const auto facets = static_cast<double>(mesh.num_facets());
  result.q_avg /= facets;
  result.theta_min_avg /= facets;
  result.theta_lt30_pct = 100 * static_cast<double>(below_30) / (3 * facets);

  std::size_t referenced = 0, interior = 0, regular = 0;
  double shortest = std::numeric_limits<double>::infinity(), sum = 0;
  double mean_edge = 0;
  for (const VertexStar& star : vertex_stars(mesh, mean_edge)) {
    if (star.edges == 0) continue;
    ++referenced;
    shortest = std::min(shortest, star.shortest);
    sum += star.shortest;
    if (star.on_boundary) continue;
    ++interior;
    regular += star.edges >= 5 && star.edges <= 7;
  }
  result.v567_pct = interior == 0 ? 0 : 100 * static_cast<double>(regular) / static_cast<double>(interior);
  const double d_max = std::sqrt(2 * area / (std::numbers::sqrt3 * static_cast<double>(referenced)));
  result.delta = d_max > 0 ? shortest / d_max : 0;
  result.edge_avg = d_max > 0 ? mean_edge / d_max : 0;
  result.delta_avg = d_max > 0 ? sum / static_cast<double>(referenced) / d_max : 0;
  return result;
}

SizingFit sizing_fit(const TriMesh& mesh, const geom::Table<VertexId, double>& h) {
  const std::vector<geom::MeshEdge> edges = geom::edges_of(mesh);

  // Sums over edges of x = log h, y = log length, r = length / h and their products.
  double sx = 0, sy = 0, sxx = 0, sxy = 0, sr = 0, srr = 0;
  for (const auto& [a, b] : edges) {
    const double length = (mesh.position(a) - mesh.position(b)).norm(), wanted = std::sqrt(h[a] * h[b]);
    const double x = std::log(wanted), y = std::log(length), r = length / wanted;
    sx += x, sy += y, sxx += x * x, sxy += x * y, sr += r, srr += r * r;
  }
  const auto n = static_cast<double>(edges.size());
  SizingFit fit;
  const double variance = sxx - sx * sx / n;
  if (variance > 1e-9 * n) fit.slope = (sxy - sx * sy / n) / variance;
  fit.mean = sr / n;
  fit.cv = std::sqrt(std::max(srr / n - fit.mean * fit.mean, 0.0)) / fit.mean;
  return fit;
}

}  // namespace fpo
