#include "fpo/measure/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "geom/check.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double rounding = 1e-9;  // an angle of 30 degrees is not below 30, however it is rounded

struct FacetQuality {
  double q;
  std::array<double, 3> angles;
};

/// Angles by the arc tangent of sine and cosine times lengths: accurate near 0 and 180 degrees too.
FacetQuality facet_quality(const TriMesh& mesh, FacetId t) {
  FacetQuality result{0, {0, 0, 0}};
  double perimeter = 0, longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 u = mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i),
               v = mesh.corner(t, (i + 2) % 3) - mesh.corner(t, i);
    result.angles[static_cast<std::size_t>(i)] = degrees * std::atan2(u.cross(v).norm(), u.dot(v));
    perimeter += u.norm();
    longest = std::max(longest, u.norm());
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
  std::vector<std::pair<VertexId, VertexId>> sides;  // ends ascending, once for each facet there
  sides.reserve(3 * mesh.num_facets());
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t e = 0; e < 3; ++e) sides.push_back(std::minmax(f[e], f[(e + 1) % 3]));
  std::ranges::sort(sides);
  std::vector<VertexStar> stars(mesh.num_vertices());
  double sum = 0, edges = 0;
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const auto& side) { return side != *first; });
    const double length = (mesh.position(first->first) - mesh.position(first->second)).norm();
    for (const VertexId v : {first->first, first->second}) {
      VertexStar& star = stars[v.index()];
      ++star.edges;
      star.on_boundary |= last - first == 1;
      star.shortest = std::min(star.shortest, length);
    }
    sum += length, ++edges;
    first = last;
  }
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
  std::vector<std::pair<VertexId, VertexId>> edges;
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t e = 0; e < 3; ++e) edges.push_back(std::minmax(f[e], f[(e + 1) % 3]));
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

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
