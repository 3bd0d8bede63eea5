#include "fpo/remesh/defects.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

#include "geom/mesh/vertex_fans.h"

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

/// An edge of a link from one end to the other.
using LinkEdge = std::array<VertexId, 2>;

/// The triangles around each vertex.
class Stars {
 public:
  explicit Stars(const TriMesh& mesh) : mesh_(mesh), end_(mesh.num_vertices() + 1, 0) {
    for (const TriMesh::Facet& f : mesh.facets())
      for (const VertexId v : f) ++end_[v.index() + 1];
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    corners_.resize(3 * mesh.num_facets());
    std::uint32_t corner = 0;
    for (const TriMesh::Facet& f : mesh.facets())
      for (const VertexId v : f) corners_[end_[v.index()]++] = corner++;  // end_: so far
  }
  /// Appends the edges opposite v, both ways.
  void append_link(VertexId v, std::vector<LinkEdge>& sides) const {
    for (std::size_t i = v.index() == 0 ? 0 : end_[v.index() - 1]; i < end_[v.index()]; ++i) {
      const TriMesh::Facet& f = mesh_.facet(geom::FacetId(std::size_t{corners_[i] / 3}));
      const VertexId a = f[(corners_[i] + 1) % 3], b = f[(corners_[i] + 2) % 3];
      sides.push_back({a, b});
      sides.push_back({b, a});
    }
  }

 private:
  const TriMesh& mesh_;
  std::vector<std::uint32_t> end_;      ///< of each star among all of them
  std::vector<std::uint32_t> corners_;  ///< three of a triangle
};

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

/// The link of v. `sides`: its edges both ways, those that begin at a vertex next to each other; `reached`: a
/// workspace.
LinkShape shape_of(VertexId v, std::span<const LinkEdge> sides, const BranchEdges& branches,
                   std::vector<VertexId>& reached) {
  if (sides.empty()) return {false, VertexId()};
  const auto sides_of = [&](VertexId v) {
    const auto first = std::ranges::lower_bound(sides, v, {}, [](const LinkEdge& edge) { return edge[0]; });
    auto last = first;
    while (last != sides.end() && last->front() == v) ++last;
    return std::span(first, last);
  };
  std::size_t num_vertices = 0;
  for (std::size_t i = 0; i < sides.size(); ++num_vertices) {
    const std::span<const LinkEdge> others = sides_of(sides[i].front());
    const VertexId w = sides[i].front();
    const bool is_twice = std::ranges::adjacent_find(others) != others.end();  // a triangle
    if (is_twice || !may_be(branches, geom::mesh_edge(v, w), others.size())) return {false, w};
    i += others.size();
  }
  reached.assign(1, sides.front()[0]);
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const auto& [u, w] : sides_of(reached[i]))
      if (std::ranges::find(reached, w) == reached.end()) reached.push_back(w);
  return {reached.size() == num_vertices, VertexId()};
}

}  // namespace

// Around a vertex whose facets are one fan or disk, each edge has one or two of them, so the link passes once
// through each of its vertices, one after the other: it is a path or a cycle. It has an edge twice only where
// two facets have the same vertices; these have two edges in common there, and follow each other.
std::vector<Defect> find_defects(const TriMesh& mesh, const BranchEdges& branches) {
  const geom::VertexFans fans(mesh);
  const auto is_in_doubt = [&](VertexId v) {
    if (!branches.empty() || fans.num_facets(v) == 0) return true;
    const geom::VertexFans::Fan fan = fans.at(v);
    return !fan.is_whole || fan.is_doubled;
  };
  std::vector<Defect> defects;
  std::vector<LinkEdge> sides;
  std::vector<VertexId> reached;
  std::optional<Stars> stars;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
    if (!is_in_doubt(VertexId(v))) continue;
    if (!stars) stars.emplace(mesh);
    sides.clear();
    stars->append_link(VertexId(v), sides);
    std::ranges::sort(sides);
    const LinkShape shape = shape_of(VertexId(v), sides, branches, reached);
    if (!shape.fan_or_disk) defects.push_back({SiteId(v), SiteId(shape.branching.value)});
  }
  return defects;
}

}  // namespace fpo
