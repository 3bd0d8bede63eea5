#include "fpo/remesh/defects.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>

namespace fpo {

using geom::SiteId;
using geom::TriMesh;
using geom::VertexId;

BranchEdges branch_edges(const FeatureSamples& features) {
  BranchEdges edges;
  for (std::size_t c = 0; c < features.chains.size(); ++c) {
    if (c >= features.sheets.size() || features.sheets[c] <= 2) continue;
    const std::vector<SiteId>& chain = features.chains[c];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      edges[geom::mesh_edge(VertexId(chain[i].value), VertexId(chain[i + 1].value))] = features.sheets[c];
  }
  return edges;
}

namespace {

/// The edges opposite a vertex in its triangles.
using Link = std::span<const std::array<VertexId, 2>>;

/// At an edge: not more than two, or as many as there are to be.
bool may_be(const BranchEdges& branches, const geom::MeshEdge& edge, std::size_t triangles) {
  const auto found = branches.find(edge);
  return found == branches.end() ? triangles <= 2 : triangles == found->second;
}

/// Whether the link is one path or one cycle; if a vertex on it has more than two edges, which.
struct LinkShape {
  bool fan_or_disk;
  VertexId branching;
};

/// The link of v.
LinkShape shape_of(VertexId v, Link link, const BranchEdges& branches) {
  if (link.empty()) return {false, VertexId()};
  using Side = std::array<VertexId, 2>;
  std::vector<Side> sides;  // both ways, those that begin at a vertex next to each other
  for (const auto& [a, b] : link) sides.insert(sides.end(), {{a, b}, {b, a}});
  std::ranges::sort(sides);
  const auto sides_of = [&](VertexId v) {
    const auto first = std::ranges::lower_bound(sides, v, {}, [](const Side& side) { return side[0]; });
    auto last = first;
    while (last != sides.end() && last->front() == v) ++last;
    return std::span(first, last);
  };
  std::size_t num_vertices = 0;
  for (std::size_t i = 0; i < sides.size(); ++num_vertices) {
    const std::span<const Side> others = sides_of(sides[i].front());
    const VertexId w = sides[i].front();
    const bool is_twice = std::ranges::adjacent_find(others) != others.end();  // a triangle
    if (is_twice || !may_be(branches, geom::mesh_edge(v, w), others.size())) return {false, w};
    i += others.size();
  }
  std::vector<VertexId> reached{link.front()[0]};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto& [u, w] : sides_of(reached[i]))
      if (std::ranges::find(reached, w) == reached.end()) reached.push_back(w);
  return {reached.size() == num_vertices, VertexId()};
}

}  // namespace

std::vector<Defect> find_defects(const TriMesh& mesh, const BranchEdges& branches) {
  std::vector<std::uint32_t> end(mesh.num_vertices() + 1, 0);  // of each link, among all of them
  for (const TriMesh::Facet& f : mesh.facets())
    for (const VertexId v : f) ++end[v.index() + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::array<VertexId, 2>> links(3 * mesh.num_facets());
  for (const TriMesh::Facet& f : mesh.facets())  // end: so far
    for (std::size_t i = 0; i < 3; ++i) links[end[f[i].index()]++] = {f[(i + 1) % 3], f[(i + 2) % 3]};
  std::vector<Defect> defects;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
    const std::size_t begin = v == 0 ? 0 : end[v - 1];
    const LinkShape shape = shape_of(VertexId(v), Link(links).subspan(begin, end[v] - begin), branches);
    if (!shape.fan_or_disk) defects.push_back({SiteId(v), SiteId(shape.branching.value)});
  }
  return defects;
}

}  // namespace fpo
