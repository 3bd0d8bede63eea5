#include "geom/mesh/vertex_clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace geom {
namespace {

using Cell = std::tuple<long, long, long>;

Cell cell_of(const Vec3& p, const Vec3& corner, double width) {
  const auto step = [&](int k) { return static_cast<long>(std::floor((p[k] - corner[k]) / width)); };
  return {step(0), step(1), step(2)};
}

}  // namespace

TriMesh clustered(const TriMesh& mesh, double width) {
  std::map<Cell, VertexId> cells;
  Table<VertexId, VertexId> cluster_of;
  Table<VertexId, Vec3> sums;
  Table<VertexId, double> counts;
  for (const Vec3& p : mesh.vertices()) {
    const auto [entry, is_new] = cells.try_emplace(cell_of(p, mesh.box().min(), width), sums.next_id());
    if (is_new) sums.push_back(Vec3(0, 0, 0)), counts.push_back(0);
    sums[entry->second] += p;
    counts[entry->second] += 1;
    cluster_of.push_back(entry->second);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[VertexId(i)] /= counts[VertexId(i)];

  std::set<TriMesh::Facet> seen;
  Table<FacetId, TriMesh::Facet> facets;
  for (TriMesh::Facet f : mesh.facets()) {
    for (VertexId& v : f) v = cluster_of[v];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
    std::rotate(f.begin(), std::ranges::min_element(f), f.end());
    if (seen.insert(f).second) facets.push_back(f);
  }
  return TriMesh(std::move(sums), std::move(facets));
}

TriMesh with_fewer_facets(const TriMesh& mesh, std::size_t most, double* width) {
  if (width) *width = 0;
  if (mesh.num_facets() <= most) return mesh;
  // On a grid of that width a surface has about 3 facets a square.
  double trial = std::max(std::sqrt(3 * mesh.area() / static_cast<double>(most)), 1e-6 * mesh.diagonal());
  for (;; trial *= 1.15) {
    TriMesh coarse = clustered(mesh, trial);
    if (coarse.num_facets() > most) continue;
    if (width) *width = trial;
    return coarse;
  }
}

}  // namespace geom
