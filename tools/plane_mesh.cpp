#include "tools/plane_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tools {

using geom::SiteId;
using geom::Vec2;
using geom::VertexId;

geom::TriMesh mesh_of(const fpo::PlaneDomain& domain) {
  const geom::Regular2& triangulation = domain.triangulation();
  const Vec2 period = domain.torus().period();
  geom::Table<VertexId, geom::Vec3> vertices;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) {
    const Vec2 p = triangulation.point(SiteId(i)).position;
    vertices.push_back({p.x(), p.y(), 0});
  }
  std::map<std::pair<SiteId, std::pair<long, long>>, VertexId> copies;
  const auto vertex = [&](SiteId s, const Vec2& at) {
    const Vec2 home = triangulation.point(s).position;
    const std::pair<long, long> shift{std::lround((at.x() - home.x()) / period.x()),
                                      std::lround((at.y() - home.y()) / period.y())};
    if (shift == std::pair<long, long>{0, 0}) return VertexId(s.index());
    const auto [copy, added] = copies.try_emplace({s, shift}, VertexId(vertices.size()));
    if (added)
      vertices.push_back({home.x() + static_cast<double>(shift.first) * period.x(),
                          home.y() + static_cast<double>(shift.second) * period.y(), 0});
    return copy->second;
  };
  std::vector<geom::Regular2::Triangle> triangles = triangulation.triangles();
  std::ranges::sort(triangles);
  geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
  for (const auto& corner : triangles) {
    const Vec2 first = triangulation.point(corner[0]).position;
    geom::TriMesh::Facet facet{VertexId(corner[0].index())};
    for (std::size_t k = 1; k < 3; ++k)
      facet[k] = vertex(corner[k], first + triangulation.difference(corner[0], corner[k]));
    facets.push_back(facet);
  }
  return geom::TriMesh(std::move(vertices), std::move(facets));
}

}  // namespace tools
