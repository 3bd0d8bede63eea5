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

/// Of samples, which are the vertices.
using Triangles = geom::Table<FacetId, geom::TriMesh::Facet>;

geom::VertexId vertex_of(SiteId s) { return geom::VertexId(s.value); }

/// Sorted, each once. `position(s)`: of a sample.
template <class Position>
geom::TriMesh mesh_of(Triangles triangles, std::size_t num_samples, const Position& position) {
  geom::require(!triangles.empty(), std::to_string(num_samples) +
                                        (num_samples == 1 ? " sample is" : " samples are") +
                                        " too few: their diagram has no triangle");
  std::sort(triangles.begin(), triangles.end());
  const auto last = std::unique(triangles.begin(), triangles.end());
  triangles.resize(static_cast<std::size_t>(last - triangles.begin()));
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  vertices.reserve(num_samples);
  for (std::size_t i = 0; i < num_samples; ++i) vertices.push_back(position(SiteId(i)));
  return geom::TriMesh(std::move(vertices), std::move(triangles));
}

}  // namespace

geom::TriMesh extract(const SurfaceDomain& domain) {
  Triangles triangles;
  triangles.reserve(2 * domain.num_samples());  // nearly, on a closed surface
  for (std::size_t s = 0; s < domain.num_samples(); ++s)
    for (const geom::CircleId c : domain.dual().circles_of(SiteId(s))) {
      const geom::EmptyCircle& circle = domain.dual().circle(c);
      if (!circle.is_triangle() || circle.sites[0] != SiteId(s)) continue;
      triangles.push_back({vertex_of(circle.sites[0]), vertex_of(circle.sites[circle.after(0)]),
                           vertex_of(circle.sites[circle.before(0)])});
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
  Triangles triangles;
  for_each_fragment(diagram, [&](SiteId i, FacetId t, std::span<const PolygonCorner> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const geom::EdgeLabel before = corners[k == 0 ? corners.size() - 1 : k - 1].edge,
                            after = corners[k].edge;
      if (!before.is_site() || !after.is_site()) continue;
      if (!(i < before.site() && i < after.site())) continue;
      geom::TriMesh::Facet triangle{vertex_of(owner_of(i, t)), vertex_of(owner_of(before.site(), t)),
                                    vertex_of(owner_of(after.site(), t))};
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
