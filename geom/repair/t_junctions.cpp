#include "geom/repair/t_junctions.h"

#include <algorithm>
#include <map>

#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

constexpr int most_zippings = 16;

/// A border vertex at a border edge.
struct Cut {
  double at;  ///< from 0 to 1 along the edge
  VertexId vertex;
  auto operator<=>(const Cut&) const = default;
};

std::vector<HalfEdge> border_of(const std::vector<HalfEdge>& half_edges) {
  std::vector<HalfEdge> border;
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first == 1) border.push_back(*first);
  });
  return border;
}

/// The facets that have these border edges; facet i is that of edge i.
TriMesh facets_of(const std::vector<HalfEdge>& border, const Table<VertexId, Vec3>& vertices) {
  Table<VertexId, Vec3> corners;
  Table<FacetId, TriMesh::Facet> edges;
  for (const HalfEdge& h : border) {
    const VertexId a(corners.size());
    corners.push_back(vertices[h.from()]);
    corners.push_back(vertices[h.to()]);
    corners.push_back(vertices[h.to()]);
    edges.push_back({a, VertexId(a.value + 1), VertexId(a.value + 2)});
  }
  return TriMesh(std::move(corners), std::move(edges));
}

/// One pass over all border edges; each facet is cut along one edge at most.
class Zip {
 public:
  Zip(const Table<VertexId, Vec3>& vertices, Facets& facets, double tolerance)
      : vertices_(vertices),
        facets_(facets),
        tolerance_(tolerance),
        half_edges_(sorted_half_edges(facets)),
        border_(border_of(half_edges_)) {}

  std::size_t run() {
    if (border_.empty()) return 0;
    std::map<std::size_t, std::vector<Cut>> cuts = find_cuts();
    std::vector<char> touched(facets_.size(), 0);
    std::size_t count = 0;
    for (auto& [edge, points] : cuts) {
      const HalfEdge& h = border_[edge];
      if (touched[h.facet.index()]) continue;
      touched[h.facet.index()] = 1;
      std::ranges::sort(points);
      count += cut(h, points);
    }
    return count;
  }

 private:
  std::map<std::size_t, std::vector<Cut>> find_cuts() const {
    const AabbTree tree(facets_of(border_, vertices_));
    std::vector<VertexId> ends;
    for (const HalfEdge& h : border_) ends.insert(ends.end(), {h.low, h.high});
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::map<std::size_t, std::vector<Cut>> cuts;
    std::vector<FacetId> near;
    for (const VertexId v : ends) {
      near.clear();
      const Vec3 reach = Vec3::Constant(tolerance_);
      tree.overlapping(Box3(Vec3(vertices_[v] - reach), Vec3(vertices_[v] + reach)), near);
      std::ranges::sort(near);
      for (const FacetId edge : near) consider(edge.index(), v, cuts);
    }
    return cuts;
  }

  void consider(std::size_t edge, VertexId v, std::map<std::size_t, std::vector<Cut>>& cuts) const {
    const HalfEdge& h = border_[edge];
    if (std::ranges::find(facets_[h.facet], v) != facets_[h.facet].end()) return;
    const Vec3 &a = vertices_[h.from()], &b = vertices_[h.to()], &p = vertices_[v];
    const Vec3 span = b - a;
    const double length = span.norm(), at = length > 0 ? (p - a).dot(span) / (length * length) : 0;
    if (!(at * length > tolerance_ && (1 - at) * length > tolerance_)) return;
    if ((p - (a + at * span)).norm() > tolerance_) return;
    cuts[edge].push_back({at, v});
  }

  /// The fan of facets from the corner across to the points along the edge. Of points nearer to each other
  /// than the tolerance the first stands for all. Nothing if an edge would come to have three facets.
  std::size_t cut(const HalfEdge& h, const std::vector<Cut>& points) {
    const double length = (vertices_[h.high] - vertices_[h.low]).norm();
    const VertexId apex = facets_[h.facet][static_cast<std::size_t>((h.edge + 2) % 3)];
    std::vector<VertexId> chain{h.from()};
    double last = 0;
    for (const Cut& c : points) {
      if ((c.at - last) * length <= tolerance_) continue;
      last = c.at;
      chain.push_back(c.vertex);
    }
    chain.push_back(h.to());
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      if (num_facets_at(half_edges_, chain[i], chain[i + 1]) > 1) return 0;
      if (i > 0 && num_facets_at(half_edges_, chain[i], apex) > 0) return 0;
    }
    facets_[h.facet] = {chain[0], chain[1], apex};
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) facets_.push_back({chain[i], chain[i + 1], apex});
    return chain.size() - 2;
  }

  const Table<VertexId, Vec3>& vertices_;
  Facets& facets_;
  double tolerance_;
  std::vector<HalfEdge> half_edges_, border_;  ///< before the pass
};

}  // namespace

std::size_t zip_t_junctions(const Table<VertexId, Vec3>& vertices, Facets& facets, double tolerance) {
  std::size_t count = 0;
  for (int pass = 0; pass < most_zippings; ++pass) {
    const std::size_t cuts = Zip(vertices, facets, tolerance).run();
    if (cuts == 0) break;
    count += cuts;
  }
  return count;
}

}  // namespace geom
