#include "geom/repair/intersections.h"

#include <algorithm>

#include "geom/exact/predicates.h"
#include "geom/mesh/aabb_tree.h"

namespace geom {
namespace {

constexpr std::size_t most_tries = 1000;  // a facet, on average

using Corners = std::array<Vec3, 3>;

/// Whether the segment from p to q passes through the triangle, neither beginning nor ending in its plane,
/// not along a side: a proper crossing.
bool crosses(const Vec3& p, const Vec3& q, const Corners& t) {
  const int at_p = orient3(t[0], t[1], t[2], p), at_q = orient3(t[0], t[1], t[2], q);
  if (at_p == 0 || at_q == 0 || at_p == at_q) return false;
  const int a = orient3(p, q, t[0], t[1]), b = orient3(p, q, t[1], t[2]), c = orient3(p, q, t[2], t[0]);
  return a != 0 && a == b && b == c;
}

bool cross(const TriMesh& mesh, FacetId s, FacetId t) {
  const TriMesh::Facet &f = mesh.facet(s), &g = mesh.facet(t);
  const Corners a{mesh.corner(s, 0), mesh.corner(s, 1), mesh.corner(s, 2)},
      b{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t n = (e + 1) % 3;
    const auto shared = [](VertexId v, const TriMesh::Facet& other) {
      return std::ranges::find(other, v) != other.end();
    };
    if (!shared(f[e], g) && !shared(f[n], g) && crosses(a[e], a[n], b)) return true;
    if (!shared(g[e], f) && !shared(g[n], f) && crosses(b[e], b[n], a)) return true;
  }
  return false;
}

}  // namespace

Intersections self_intersections(const TriMesh& mesh) {
  Intersections result;
  if (mesh.num_facets() == 0) return result;
  const AabbTree tree(mesh);
  std::vector<FacetId> near;
  std::size_t tries = 0;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    Box3 box;
    for (int i = 0; i < 3; ++i) box.extend(mesh.corner(t, i));
    near.clear();
    tree.overlapping(box, near);
    for (const FacetId s : near) {
      if (s <= t) continue;
      if (++tries > most_tries * mesh.num_facets()) {
        result.all = false;
        return result;
      }
      if (!cross(mesh, t, s)) continue;
      ++result.pairs;
      if (!result.first.valid()) result.first = t;
    }
  }
  return result;
}

}  // namespace geom
