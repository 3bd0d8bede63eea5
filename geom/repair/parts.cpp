#include "geom/repair/parts.h"

#include "geom/disjoint_sets.h"
#include "geom/mesh/half_edges.h"
#include "geom/repair/flat_facets.h"

namespace geom {

std::vector<MeshPart> mesh_parts(const Table<VertexId, Vec3>& vertices,
                                 const Table<FacetId, TriMesh::Facet>& facets) {
  DisjointSets sets(facets.size());
  std::vector<char> open(facets.size(), 0);
  const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first != 2) open[first->facet.index()] = 1;
    for (auto h = first + 1; h != last; ++h) sets.merge_to_least(first->facet.index(), h->facet.index());
  });
  std::vector<MeshPart> parts;
  std::vector<std::size_t> part_of(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const std::size_t first = sets.find(i);
    if (first == i) part_of[i] = parts.size(), parts.emplace_back();
    MeshPart& part = parts[part_of[first]];
    const auto& [a, b, c] = facets[FacetId(i)];
    part.facets.push_back(FacetId(i));
    part.area += (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).norm() / 2;
    part.closed = part.closed && !open[i];
  }
  return parts;
}

double share_of_small_parts(const TriMesh& mesh, double n, double least) {
  const std::vector<MeshPart> parts = mesh_parts(mesh.vertices(), mesh.facets());
  double area = 0, small = 0;
  for (const MeshPart& part : parts) area += part.area;
  for (const MeshPart& part : parts) small += n * part.area < least * area ? part.area : 0;
  return area > 0 ? small / area : 0;
}

std::size_t drop_crumbs(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                        const CrumbLimits& limits) {
  const std::vector<MeshPart> parts = mesh_parts(vertices, facets);
  double area = 0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    area += parts[i].area;
    if (parts[i].area > parts[largest].area) largest = i;
  }
  const double few = std::max(static_cast<double>(limits.few_facets),
                              limits.open_share * static_cast<double>(facets.size()));
  Table<FacetId, char> marked(facets.size(), 0);
  std::size_t dropped = 0;
  double dropped_area = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const MeshPart& part = parts[i];
    const bool small =
        part.closed ? part.area < limits.closed_share * area
                    : part.area < limits.open_share * area || static_cast<double>(part.facets.size()) <= few;
    if (i == largest || !small) continue;
    ++dropped;
    dropped_area += part.area;
    for (const FacetId t : part.facets) marked[t] = 1;
  }
  if (dropped_area > limits.most_share * area) return 0;
  if (dropped > 0) drop_marked(marked, facets);
  return dropped;
}

}  // namespace geom
