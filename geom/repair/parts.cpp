#include "geom/repair/parts.h"

#include <algorithm>

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

double area_of(const std::vector<MeshPart>& parts) {
  double area = 0;
  for (const MeshPart& part : parts) area += part.area;
  return area;
}

double share_of_small_parts(const TriMesh& mesh, double n, double least) {
  const std::vector<MeshPart> parts = mesh_parts(mesh.vertices(), mesh.facets());
  const double area = area_of(parts);
  double small = 0;
  for (const MeshPart& part : parts) small += n * part.area < least * area ? part.area : 0;
  return area > 0 ? small / area : 0;
}

namespace {

/// Removes the facets of those parts, unless that is too much of the area. Returns how many parts.
std::size_t drop_parts(const std::vector<const MeshPart*>& crumbs, double most_area,
                       Table<FacetId, TriMesh::Facet>& facets) {
  double area = 0;
  for (const MeshPart* part : crumbs) area += part->area;
  if (area > most_area || crumbs.empty()) return 0;
  Table<FacetId, char> marked(facets.size(), 0);
  for (const MeshPart* part : crumbs)
    for (const FacetId t : part->facets) marked[t] = 1;
  drop_marked(marked, facets);
  return crumbs.size();
}

/// For each part the largest of those that hang together with it by vertices.
std::vector<std::size_t> largest_in_reach(const std::vector<MeshPart>& parts, std::size_t num_vertices,
                                          const Table<FacetId, TriMesh::Facet>& facets) {
  DisjointSets sets(num_vertices);
  for (const TriMesh::Facet& f : facets)
    sets.merge(f[0].index(), f[1].index()), sets.merge(f[0].index(), f[2].index());
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  const auto set_of = [&](std::size_t i) { return sets.find(facets[parts[i].facets.front()][0].index()); };
  std::vector<std::size_t> largest(num_vertices, none), result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::size_t& best = largest[set_of(i)];
    if (best == none || parts[i].area > parts[best].area) best = i;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) result.push_back(largest[set_of(i)]);
  return result;
}

}  // namespace

std::size_t drop_crumbs(const Table<VertexId, Vec3>& vertices, Table<FacetId, TriMesh::Facet>& facets,
                        const CrumbLimits& limits) {
  const std::vector<MeshPart> parts = mesh_parts(vertices, facets);
  const double area = area_of(parts);
  const auto largest = std::ranges::max_element(parts, {}, &MeshPart::area);
  const double few = std::max(static_cast<double>(limits.few_facets),
                              limits.open_share * static_cast<double>(facets.size()));
  std::vector<const MeshPart*> crumbs;
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    const bool small = part->closed ? part->area < limits.closed_share * area
                                    : part->area < limits.open_share * area ||
                                          static_cast<double>(part->facets.size()) <= few;
    if (part != largest && small) crumbs.push_back(&*part);
  }
  return drop_parts(crumbs, limits.most_share * area, facets);
}

std::size_t drop_hanging_crumbs(const Table<VertexId, Vec3>& vertices,
                                Table<FacetId, TriMesh::Facet>& facets) {
  const std::vector<MeshPart> parts = mesh_parts(vertices, facets);
  if (parts.size() < 2) return 0;
  const double area = area_of(parts);
  const std::vector<std::size_t> largest = largest_in_reach(parts, vertices.size(), facets);
  std::vector<const MeshPart*> crumbs;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (largest[i] != i && !parts[i].closed && parts[i].area < hanging_share * area)
      crumbs.push_back(&parts[i]);
  return drop_parts(crumbs, most_hanging * area, facets);
}

}  // namespace geom
