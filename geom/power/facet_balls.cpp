#include "geom/power/facet_balls.h"

#include <algorithm>

namespace geom {

FacetBalls::FacetBalls(const TriMesh& mesh, double extent) : levels_(mesh) {
  balls_.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    Box3 box;
    for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
    const Vec3 center = box.center();
    double radius = 0;
    for (int i = 0; i < 3; ++i) radius = std::max(radius, (mesh.corner(t, i) - center).norm());
    balls_.push_back({center, radius * (1 + 0x1p-40) + 0x1p-48 * extent});
  }
}

}  // namespace geom
