#include "geom/repair/spikes.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace geom {
namespace {

constexpr std::size_t least_neighbours = 4, most_neighbours = 12, vertices_for_one_spike = 20;
constexpr double far = 8, far_in_crowd = 1.5;
constexpr std::size_t crowd = 4;  // vertices at one place
constexpr int most_passes = 4;

/// The lower one of two.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + (std::ssize(values) - 1) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

Vec3 median(const Table<VertexId, Vec3>& vertices, const std::vector<VertexId>& ring) {
  Vec3 result;
  std::vector<double> values(ring.size());
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < ring.size(); ++i) values[i] = vertices[ring[i]][k];
    result[k] = median(values);
  }
  return result;
}

/// The neighbours of each vertex, ascending.
Table<VertexId, std::vector<VertexId>> rings(std::size_t num_vertices,
                                             const Table<FacetId, TriMesh::Facet>& facets) {
  Table<VertexId, std::vector<VertexId>> result(num_vertices);
  for (const TriMesh::Facet& f : facets)
    for (std::size_t i = 0; i < 3; ++i) {
      result[f[i]].push_back(f[(i + 1) % 3]);
      result[f[i]].push_back(f[(i + 2) % 3]);
    }
  for (std::vector<VertexId>& ring : result) {
    std::ranges::sort(ring);
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  }
  return result;
}

/// Whether so many vertices are at the place of each that they make a crowd.
Table<VertexId, char> crowded(const Table<VertexId, Vec3>& vertices) {
  std::vector<VertexId> order;
  for (VertexId v(0); v.index() < vertices.size(); v = VertexId(v.value + 1)) order.push_back(v);
  const auto place = [&](VertexId v) {
    return std::tuple(vertices[v].x(), vertices[v].y(), vertices[v].z());
  };
  std::ranges::sort(order, {}, place);
  Table<VertexId, char> result(vertices.size(), false);
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && place(order[last]) == place(order[first])) ++last;
    for (std::size_t i = first; i < last && last - first >= crowd; ++i) result[order[i]] = true;
  }
  return result;
}

bool is_spike(const Table<VertexId, Vec3>& vertices, const Spike& at,
              const Table<VertexId, std::vector<VertexId>>& rings, bool in_crowd) {
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<double> widths, edges;
  for (const VertexId u : rings[at.vertex]) {
    const double length = (vertices[u] - vertices[at.vertex]).norm();
    if (!in_crowd || length > 0) nearest = std::min(nearest, length);
    widths.push_back((vertices[u] - at.base).norm());
    edges.push_back(0);
    for (const VertexId w : rings[u])
      if (w != at.vertex) edges.back() = std::max(edges.back(), (vertices[u] - vertices[w]).norm());
  }
  return nearest > (in_crowd ? far_in_crowd : far) * std::max(median(widths), median(edges));
}

}  // namespace

std::vector<Spike> spikes(const Table<VertexId, Vec3>& vertices,
                          const Table<FacetId, TriMesh::Facet>& facets) {
  std::vector<Spike> found;
  const Table<VertexId, std::vector<VertexId>> around = rings(vertices.size(), facets);
  const Table<VertexId, char> in_crowd = crowded(vertices);
  for (VertexId v(0); v.index() < vertices.size(); v = VertexId(v.value + 1)) {
    if (around[v].size() < least_neighbours || around[v].size() > most_neighbours) continue;
    const Spike at{v, median(vertices, around[v])};
    if (is_spike(vertices, at, around, in_crowd[v])) found.push_back(at);
  }
  if (vertices_for_one_spike * found.size() > vertices.size()) found.clear();
  return found;
}

std::size_t flatten_spikes(Table<VertexId, Vec3>& vertices, const Table<FacetId, TriMesh::Facet>& facets) {
  std::size_t moves = 0;
  for (int pass = 0; pass < most_passes; ++pass) {
    const std::vector<Spike> found = spikes(vertices, facets);
    for (const Spike& spike : found) vertices[spike.vertex] = spike.base;
    moves += found.size();
    if (found.empty()) break;
  }
  return moves;
}

}  // namespace geom
