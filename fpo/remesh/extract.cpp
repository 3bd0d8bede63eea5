#include "fpo/remesh/extract.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "geom/check.h"

namespace fpo {

using geom::FacetId;
using geom::FragmentId;
using geom::PolygonCorner;
using geom::SiteId;

namespace {

template <class Visit>
void for_each_fragment(const geom::RestrictedPower& diagram, Visit visit) {
  const geom::FragmentStore& fragments = diagram.fragments();
  std::array<PolygonCorner, 3> buffer;
  for (FacetId t(0); t.index() < diagram.mesh().num_facets(); t = FacetId(t.value + 1))
    for (const FragmentId f : fragments.of_facet(t))
      visit(fragments.site(f), t, fragments.corners(f, buffer));
}

using Triangle = std::array<SiteId, 3>;

/// Sorted, each once. `position(s)`: of a sample.
template <class Position>
geom::TriMesh mesh_of(std::vector<Triangle> triangles, std::size_t num_samples, const Position& position) {
  geom::require(!triangles.empty(), std::to_string(num_samples) +
                                        (num_samples == 1 ? " sample is" : " samples are") +
                                        " too few: their diagram has no triangle");
  std::ranges::sort(triangles);
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  for (std::size_t i = 0; i < num_samples; ++i) vertices.push_back(position(SiteId(i)));
  geom::Table<FacetId, geom::TriMesh::Facet> facets;
  for (const auto& [i, j, k] : triangles)
    facets.push_back({geom::VertexId(i.value), geom::VertexId(j.value), geom::VertexId(k.value)});
  return geom::TriMesh(std::move(vertices), std::move(facets));
}

}  // namespace

geom::TriMesh extract(const SurfaceDomain& domain) {
  std::vector<Triangle> triangles;
  for (std::size_t s = 0; s < domain.num_samples(); ++s)
    for (const geom::CircleId c : domain.dual().circles_of(SiteId(s))) {
      const geom::EmptyCircle& circle = domain.dual().circle(c);
      if (!circle.is_triangle() || circle.sites[0] != SiteId(s)) continue;
      triangles.push_back({circle.sites[0], circle.sites[circle.after(0)], circle.sites[circle.before(0)]});
    }
  return mesh_of(std::move(triangles), domain.num_samples(),
                 [&](SiteId s) { return domain.sample(s).position; });
}

//            k            Around the corner the cells of i, j, k follow each other. Seen from i, whose
//        \      /         polygon runs counterclockwise, the edge before the corner is labelled j and the
//     i   ------   j      edge after it k, and the triangle i, j, k is counterclockwise too. Each corner is
//        /      \         met three times, once from each of its cells: the smallest id takes it.
geom::TriMesh extract(const geom::RestrictedPower& diagram, std::size_t num_samples,
                      const FragmentOwners& owners) {
  const auto owner_of = [&](SiteId s, FacetId t) {
    if (owners.empty()) return s;
    const auto found = owners.find(diagram.fragments().find(s, t));
    return found == owners.end() ? s : found->second;
  };
  std::vector<Triangle> triangles;
  for_each_fragment(diagram, [&](SiteId i, FacetId t, std::span<const PolygonCorner> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const geom::EdgeLabel before = corners[k == 0 ? corners.size() - 1 : k - 1].edge,
                            after = corners[k].edge;
      if (!before.is_site() || !after.is_site()) continue;
      if (!(i < before.site() && i < after.site())) continue;
      Triangle triangle{owner_of(i, t), owner_of(before.site(), t), owner_of(after.site(), t)};
      std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
        triangles.push_back(triangle);
    }
  });
  return mesh_of(std::move(triangles), num_samples, [&](SiteId s) { return diagram.site(s).position; });
}

std::vector<CellPolygon> cell_polygons(const geom::RestrictedPower& diagram) {
  std::vector<CellPolygon> polygons;
  for_each_fragment(diagram, [&](SiteId i, FacetId t, std::span<const PolygonCorner> corners) {
    CellPolygon& polygon = polygons.emplace_back(CellPolygon{i, t, {}});
    const auto first = std::ranges::min_element(corners, {}, &PolygonCorner::edge);
    for (auto corner = first; corner != corners.end(); ++corner)
      polygon.corners.push_back(corner->point.position);
    for (auto corner = corners.begin(); corner != first; ++corner)
      polygon.corners.push_back(corner->point.position);
  });
  std::ranges::sort(polygons, {}, [](const CellPolygon& p) { return std::tuple(p.site, p.facet); });
  return polygons;
}

}  // namespace fpo
