#include "geom/repair/flat_facets.h"

#include <set>

#include "geom/exact/predicates.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

constexpr int most_passes = 16;

Vec2 without(const Vec3& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

/// One pass over the facets without area.
class FlatPass {
 public:
  FlatPass(const Table<VertexId, Vec3>& vertices, Facets& facets)
      : vertices_(vertices),
        facets_(facets),
        half_edges_(sorted_half_edges(facets)),
        dropped_(facets.size(), 0),
        touched_(facets.size(), 0) {}

  /// Whether anything was changed. What was dropped before counts in `result`, too.
  bool run(Flattening& result) {
    const Flattening before = result;
    result.left = 0;
    for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1))
      if (is_flat(facets_[t])) mend(t, result);
    drop_marked(dropped_, facets_);
    return result.dropped + result.flipped > before.dropped + before.flipped;
  }

 private:
  bool is_flat(const TriMesh::Facet& f) const {
    return collinear(vertices_[f[0]], vertices_[f[1]], vertices_[f[2]]);
  }

  int longest_edge(const TriMesh::Facet& f) const {
    int longest = 0;
    double most = -1;
    for (int e = 0; e < 3; ++e) {
      const double length =
          (vertices_[f[static_cast<std::size_t>(e)]] - vertices_[f[static_cast<std::size_t>((e + 1) % 3)]])
              .squaredNorm();
      if (length > most) most = length, longest = e;
    }
    return longest;
  }

  /// The one facet beside t at the edge a b; none at borders and where there are more.
  FacetId beside(FacetId t, VertexId a, VertexId b) const {
    const std::span<const HalfEdge> sides = half_edges_at(half_edges_, a, b);
    if (sides.size() != 2) return FacetId();
    return sides[0].facet == t ? sides[1].facet : sides[0].facet;
  }

  //      c               c
  //    /   \           / | \.
  //   a ---- b   ->   a  |  b      m lies on the edge a b
  //    \ m  /          \ | /
  //                      m
  void mend(FacetId t, Flattening& result) {
    if (touched_[t]) {
      ++result.left;  // in this pass
      return;
    }
    const TriMesh::Facet f = facets_[t];
    const auto e = static_cast<std::size_t>(longest_edge(f));
    VertexId a = f[e], b = f[(e + 1) % 3];
    const VertexId m = f[(e + 2) % 3];
    const FacetId other = beside(t, a, b);
    if (!other.valid()) {
      dropped_[t] = touched_[t] = 1;
      ++result.dropped;
      return;
    }
    const TriMesh::Facet g = facets_[other];
    const auto at_b = static_cast<std::size_t>(std::ranges::find(g, b) - g.begin());
    if (g[(at_b + 1) % 3] != a) std::swap(a, b);  // turned the other way
    VertexId c;
    for (const VertexId v : g)
      if (v != a && v != b) c = v;
    const bool possible = !touched_[other] && c != m && !joined_.contains(std::minmax(m, c)) &&
                          num_facets_at(half_edges_, m, c) == 0 && !is_flat({m, a, c});
    if (!possible) {
      ++result.left;
      return;
    }
    facets_[t] = {m, a, c};
    facets_[other] = {c, b, m};
    touched_[t] = touched_[other] = 1;
    joined_.insert(std::minmax(m, c));
    ++result.flipped;
  }

  const Table<VertexId, Vec3>& vertices_;
  Facets& facets_;
  std::vector<HalfEdge> half_edges_;  ///< before the pass
  Table<FacetId, char> dropped_, touched_;
  std::set<std::pair<VertexId, VertexId>> joined_;  ///< by the pass
};

}  // namespace

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  constexpr double surely = 1e-20;  // far beyond the rounding of the product
  if (u.cross(v).squaredNorm() > surely * u.squaredNorm() * v.squaredNorm() &&
      std::min(u.squaredNorm(), v.squaredNorm()) >
          1e-12 * std::max(a.squaredNorm(), std::max(b.squaredNorm(), c.squaredNorm())))
    return false;
  for (int axis = 0; axis < 3; ++axis)
    if (orient2(without(a, axis), without(b, axis), without(c, axis)) != 0) return false;
  return true;
}

void drop_marked(const Table<FacetId, char>& marked, Facets& facets) {
  Facets kept;
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
    if (!marked[t]) kept.push_back(facets[t]);
  facets = std::move(kept);
}

std::size_t drop_collapsed(const Places& places, Facets& facets) {
  const std::size_t before = facets.size();
  Table<FacetId, char> marked;
  for (const auto& [a, b, c] : facets)
    marked.push_back(places[a] == places[b] || places[b] == places[c] || places[c] == places[a]);
  drop_marked(marked, facets);
  return before - facets.size();
}

Flattening mend_flat(const Table<VertexId, Vec3>& vertices, Facets& facets) {
  Flattening result;
  bool any = false;
  for (const auto& [a, b, c] : facets) any = any || collinear(vertices[a], vertices[b], vertices[c]);
  for (int pass = 0; any && pass < most_passes; ++pass) any = FlatPass(vertices, facets).run(result);
  return result;
}

}  // namespace geom
