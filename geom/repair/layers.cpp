#include "geom/repair/layers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "geom/rng.h"

namespace geom {
namespace {

/// Points spread evenly, in random order.
std::vector<Vec3> random_points(const TriMesh& mesh, std::size_t count, Rng& rng) {
  std::vector<double> up_to;
  double sum = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    up_to.push_back(sum += mesh.area(t));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::ranges::upper_bound(up_to, sum * rng.uniform());
    const FacetId t(static_cast<std::size_t>(std::min(at, up_to.end() - 1) - up_to.begin()));
    double u = rng.uniform(), v = rng.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    points.push_back((1 - u - v) * mesh.corner(t, 0) + u * mesh.corner(t, 1) + v * mesh.corner(t, 2));
  }
  return points;
}

}  // namespace

double layers_within(const TriMesh& mesh, double distance) {
  constexpr std::size_t places = 64;
  const double area = mesh.area(), disk = std::numbers::pi * distance * distance;
  if (!(area > 0) || !(disk > 0)) return 0;
  const auto count = static_cast<std::size_t>(std::clamp(4 * area / disk, 4096.0, 4e5));
  Rng rng(1);
  const std::vector<Vec3> points = random_points(mesh, count, rng);
  std::vector<double> layers;
  for (std::size_t i = 0; i < places; ++i) {
    const auto near = std::ranges::count_if(
        points, [&](const Vec3& p) { return (p - points[i]).squaredNorm() <= distance * distance; });
    layers.push_back(static_cast<double>(near) / static_cast<double>(count) * area / disk);
  }
  std::ranges::nth_element(layers, layers.begin() + places / 2);
  return layers[places / 2];
}

}  // namespace geom
