#include "geom/mesh/levels.h"

namespace geom {
namespace {

constexpr double least_height = 0x1p-10;  // of a facet, in its longest edge, for a gradient of any use

}  // namespace

// The gradient g in the plane of the facet with g.u = a and g.v = b, u and v the edges from corner 0 and n
// their product: g = (a (v x n) + b (n x u)) / |n|^2. If no height is less than 2^-10 of the longest edge, it
// is off by less than 2^-25 of the differences of levels, over that height.
FacetLevels::FacetLevels(const TriMesh& mesh) {
  if (!mesh.has_levels()) return;
  facets_.reserve(mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const TriMesh::Facet& corners = mesh.facet(t);
    const std::array<double, 3> at{mesh.level(corners[0]), mesh.level(corners[1]), mesh.level(corners[2])};
    const auto [least, most] = std::ranges::minmax(at);
    Facet facet{least, most, at[0], most - least, 0, mesh.corner(t, 0), Vec3(0, 0, 0)};
    const Vec3 u = mesh.corner(t, 1) - mesh.corner(t, 0), v = mesh.corner(t, 2) - mesh.corner(t, 0);
    const Vec3 n = u.cross(v);
    const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
    if (n.norm() > least_height * longest2) {
      facet.gradient = ((at[1] - at[0]) * v.cross(n) + (at[2] - at[0]) * n.cross(u)) / n.squaredNorm();
      facet.steepness = 2 * facet.gradient.norm();
      facet.error = 0x1p-25 * (most - least);
    }
    facets_.push_back(facet);
  }
}

}  // namespace geom
