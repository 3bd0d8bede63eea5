#include "geom/repair/border_loops.h"

#include <algorithm>
#include <map>

#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

/// Border edges by the vertices where they begin and end.
class Border {
 public:
  explicit Border(const Table<FacetId, TriMesh::Facet>& facets) {
    const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
    for_each_edge(half_edges, [&](auto first, auto last) {
      if (last - first == 1) edges_.push_back(*first);
    });
    used_.assign(edges_.size(), 0);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      leaving_[edges_[i].from()].edges.push_back(i);
      arriving_[edges_[i].to()].edges.push_back(i);
    }
  }

  /// The vertices of a walk that starts with edge i and goes on while it can; empty if that has been walked.
  std::vector<VertexId> walk(std::size_t i) {
    if (used_[i]) return {};
    used_[i] = 1;
    std::vector<VertexId> path{edges_[i].from(), edges_[i].to()};
    while (path.front() != path.back()) {
      const VertexId next = step(path.back());
      if (!next.valid()) break;
      path.push_back(next);
    }
    return path;
  }
  std::size_t size() const { return edges_.size(); }

 private:
  /// Along an edge that leaves, or, if facets disagree, against one that arrives.
  VertexId step(VertexId at) {
    if (const HalfEdge* edge = take_from(leaving_[at])) return edge->to();
    if (const HalfEdge* edge = take_from(arriving_[at])) return edge->from();
    return VertexId();
  }

  /// Edges at a vertex; those before `first` are used.
  struct AtVertex {
    std::vector<std::size_t> edges;
    std::size_t first = 0;
  };

  /// The first that is not used, or none.
  const HalfEdge* take_from(AtVertex& list) {
    for (; list.first < list.edges.size(); ++list.first) {
      const std::size_t i = list.edges[list.first];
      if (!used_[i]) return used_[i] = 1, &edges_[i];
    }
    return nullptr;
  }

  std::vector<HalfEdge> edges_;
  std::vector<char> used_;
  std::map<VertexId, AtVertex> leaving_, arriving_;
};

BorderLoop measured(std::vector<VertexId> cycle, bool simple, const Table<VertexId, Vec3>& vertices) {
  BorderLoop loop;
  loop.simple = simple;
  const Vec3& origin = vertices[cycle.front()];
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const Vec3 &a = vertices[cycle[i]], &b = vertices[cycle[(i + 1) % cycle.size()]];
    if (!simple && i + 1 == cycle.size()) break;
    loop.length += (b - a).norm();
    loop.vector_area += (a - origin).cross(b - origin) / 2;
  }
  loop.vertices = std::move(cycle);
  return loop;
}

}  // namespace

// A walk that comes back to one of its vertices leaves a cycle behind and goes on from there.
std::vector<BorderLoop> border_loops(const Table<VertexId, Vec3>& vertices,
                                     const Table<FacetId, TriMesh::Facet>& facets) {
  std::vector<BorderLoop> loops;
  Border border(facets);
  for (std::size_t i = 0; i < border.size(); ++i) {
    const std::vector<VertexId> path = border.walk(i);
    std::vector<VertexId> open;
    std::map<VertexId, std::size_t> place;
    for (const VertexId v : path) {
      if (const auto seen = place.find(v); seen != place.end()) {
        const auto first = open.begin() + static_cast<std::ptrdiff_t>(seen->second);
        loops.push_back(measured(std::vector<VertexId>(first, open.end()), true, vertices));
        for (auto u = first + 1; u != open.end(); ++u) place.erase(*u);
        open.erase(first + 1, open.end());
        continue;
      }
      place[v] = open.size();
      open.push_back(v);
    }
    if (open.size() > 1) loops.push_back(measured(open, false, vertices));
  }
  return loops;
}

}  // namespace geom
