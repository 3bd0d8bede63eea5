#include "fpo/remesh/facet_region.h"

#include <algorithm>

#include "fpo/measure/triangle_angles.h"

namespace fpo {

using geom::FacetId;
using geom::VertexId;

std::array<double, 3> angles_of(const EditedMesh& mesh, FacetId t) {
  const EditedMesh::Facet& f = mesh.facet(t);
  return angles_of({mesh.position(f[0]), mesh.position(f[1]), mesh.position(f[2])});
}

double least_angle(const EditedMesh& mesh, FacetId t) { return std::ranges::min(angles_of(mesh, t)); }

FacetRegion region_of(const EditedMesh& mesh, const std::vector<VertexId>& vertices) {
  FacetRegion region;
  for (const VertexId v : vertices)
    region.insert(region.end(), mesh.facets_at(v).begin(), mesh.facets_at(v).end());
  std::ranges::sort(region);
  region.erase(std::unique(region.begin(), region.end()), region.end());
  return region;
}

std::vector<VertexId> vertices_of(const EditedMesh& mesh, const FacetRegion& region) {
  std::vector<VertexId> vertices;
  for (const FacetId t : region) vertices.insert(vertices.end(), mesh.facet(t).begin(), mesh.facet(t).end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace fpo
