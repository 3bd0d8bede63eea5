#include "geom/mesh/opened_mesh.h"

#include <utility>
#include <vector>

namespace geom {

OpenedMesh opened(const TriMesh& mesh, DisjointSets& corners) {
  std::vector<VertexId> vertex(3 * mesh.num_facets());  // of each set
  Table<VertexId, Vec3> positions;
  Table<VertexId, VertexId> origin;
  Table<FacetId, TriMesh::Facet> facets;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    TriMesh::Facet facet = mesh.facet(t);
    for (std::size_t i = 0; i < 3; ++i) {
      VertexId& v = vertex[corners.find(3 * t.index() + i)];
      if (!v.valid()) {
        v = VertexId(positions.size());
        positions.push_back(mesh.position(facet[i]));
        origin.push_back(facet[i]);
      }
      facet[i] = v;
    }
    facets.push_back(facet);
  }
  return {TriMesh(std::move(positions), std::move(facets)), std::move(origin)};
}

}  // namespace geom
