#include "fpo/features/given_points.h"

#include <cmath>
#include <string>

#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::TriMesh;
using geom::Vec3;

std::vector<SurfaceSample> points_on_surface(const TriMesh& mesh, std::span<const Vec3> points) {
  std::vector<SurfaceSample> samples;
  if (points.empty()) return samples;
  const geom::AabbTree tree(mesh);
  for (std::size_t i = 0; i < points.size(); ++i) {
    geom::require(points[i].allFinite(), "point " + std::to_string(i + 1) + " is not finite");
    const geom::AabbTree::Closest closest = tree.closest(points[i]);
    geom::require(closest.distance2 <= std::pow(point_tolerance * mesh.diagonal(), 2),
                  "point " + std::to_string(i + 1) + " does not lie on the surface");
    samples.push_back({points[i], closest.facet});
  }
  return samples;
}

}  // namespace fpo
