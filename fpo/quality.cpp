#include "fpo/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geom/check.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;

namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct FacetQuality {
  double q;
  std::array<double, 3> angles;
};

FacetQuality facet_quality(const TriMesh& mesh, FacetId t) {
  FacetQuality result{0, {0, 0, 180}};
  const double area = mesh.area(t);
  if (!(area > 0)) return result;
  std::array<double, 3> edges{};
  for (int i = 0; i < 3; ++i)
    edges[static_cast<std::size_t>(i)] = (mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i)).norm();
  const double half_perimeter = (edges[0] + edges[1] + edges[2]) / 2;
  result.q = 6 / std::numbers::sqrt3 * area / (half_perimeter * std::ranges::max(edges));
  for (int i = 0; i < 3; ++i) {
    const Vec3 u = mesh.corner(t, (i + 1) % 3) - mesh.corner(t, i),
               v = mesh.corner(t, (i + 2) % 3) - mesh.corner(t, i);
    result.angles[static_cast<std::size_t>(i)] = degrees * std::atan2(u.cross(v).norm(), u.dot(v));
  }
  return result;
}

/// What the edges say of each vertex.
struct VertexStar {
  std::size_t facets = 0, borders = 0;
  double shortest = std::numeric_limits<double>::infinity();
};

std::vector<VertexStar> vertex_stars(const TriMesh& mesh) {
  std::vector<VertexStar> stars(mesh.num_vertices());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const std::size_t a = mesh.facet(t)[static_cast<std::size_t>(e)].index(),
                        b = mesh.facet(t)[static_cast<std::size_t>((e + 1) % 3)].index();
      const double length = (mesh.corner(t, (e + 1) % 3) - mesh.corner(t, e)).norm();
      ++stars[a].facets;
      for (const std::size_t v : {a, b}) {
        stars[v].shortest = std::min(stars[v].shortest, length);
        stars[v].borders += !mesh.across(t, e).valid();
      }
    }
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
    below_30 += static_cast<std::size_t>(std::ranges::count_if(f.angles, [](double a) { return a < 30; }));
  }
  const auto facets = static_cast<double>(mesh.num_facets());
  result.q_avg /= facets;
  result.theta_min_avg /= facets;
  result.theta_lt30_pct = 100 * static_cast<double>(below_30) / (3 * facets);

  // An interior vertex has as many edges as facets.
  std::size_t referenced = 0, interior = 0, regular = 0;
  double shortest = std::numeric_limits<double>::infinity(), sum = 0;
  for (const VertexStar& star : vertex_stars(mesh)) {
    if (star.facets == 0) continue;
    ++referenced;
    shortest = std::min(shortest, star.shortest);
    sum += star.shortest;
    if (star.borders > 0) continue;
    ++interior;
    regular += star.facets >= 5 && star.facets <= 7;
  }
  result.v567_pct = interior == 0 ? 0 : 100 * static_cast<double>(regular) / static_cast<double>(interior);
  const double d_max = std::sqrt(2 * area / (std::numbers::sqrt3 * static_cast<double>(referenced)));
  result.delta = d_max > 0 ? shortest / d_max : 0;
  result.delta_avg = d_max > 0 ? sum / static_cast<double>(referenced) / d_max : 0;
  return result;
}

}  // namespace fpo
