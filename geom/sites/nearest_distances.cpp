#include "geom/sites/nearest_distances.h"

#include <cmath>

#include "geom/parallel.h"
#include "geom/sites/point_tree.h"

namespace geom {

std::vector<double> nearest_distances(std::span<const Vec3> points, std::size_t first, int threads) {
  const PointTree tree(points);
  std::vector<double> distances(points.size() - first);
  parallel_ranges(distances.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      distances[i] = std::sqrt(tree.nearest(points[first + i], SiteId(first + i)).radius2);
  });
  return distances;
}

}  // namespace geom
