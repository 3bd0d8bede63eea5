#include "fpo/remesh/layers.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "fpo/surface/initial_samples.h"

namespace fpo {

double layers_within(const geom::TriMesh& mesh, double distance) {
  constexpr std::size_t places = 64;
  const double area = mesh.area(), disk = std::numbers::pi * distance * distance;
  if (!(area > 0) || !(disk > 0)) return 0;
  const auto count = static_cast<std::size_t>(std::clamp(4 * area / disk, 4096.0, 4e5));
  const std::vector<SurfaceSample> points = random_samples(mesh, count, 1);
  std::vector<double> layers;
  for (std::size_t i = 0; i < places; ++i) {
    const auto near = std::ranges::count_if(points, [&](const SurfaceSample& p) {
      return (p.position - points[i].position).squaredNorm() <= distance * distance;
    });
    layers.push_back(static_cast<double>(near) / static_cast<double>(count) * area / disk);
  }
  std::ranges::nth_element(layers, layers.begin() + places / 2);
  return layers[places / 2];
}

}  // namespace fpo
