#include "fpo/surface/barycentric.h"

#include <array>

#include "geom/mesh/aabb_tree.h"

namespace fpo {

std::vector<geom::Vec3> barycentric_coordinates(const geom::TriMesh& surface,
                                                std::span<const SurfaceSample> samples) {
  const double factor = geom::factor_to_unit_box(surface);  // where no square of a length under- or overflows
  std::vector<geom::Vec3> result;
  result.reserve(samples.size());
  for (const SurfaceSample& x : samples) {
    const std::array<geom::Vec3, 3> triangle{factor * surface.corner(x.facet, 0),
                                             factor * surface.corner(x.facet, 1),
                                             factor * surface.corner(x.facet, 2)};
    result.push_back(geom::closest_point(factor * x.position, triangle).barycentric);
  }
  return result;
}

}  // namespace fpo
