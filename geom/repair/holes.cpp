#include "geom/repair/holes.h"

#include <algorithm>
#include <map>
#include <set>

#include "geom/mesh/half_edges.h"
#include "geom/repair/fill_polygon.h"
#include "geom/repair/patch.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;
using Ends = std::pair<VertexId, VertexId>;

/// A mesh whose holes are being filled.
class Filler {
 public:
  Filler(Table<VertexId, Vec3>& vertices, Facets& facets) : vertices_(vertices), facets_(facets) {
    for (const HalfEdge& h : sorted_half_edges(facets)) {
      ++count_[h.ends()];
      facet_at_[h.ends()] = h.facet;
      if (h.edge == 0)
        for (const VertexId v : facets[h.facet]) at_vertex_[v].push_back(h.facet);
    }
    for (TriMesh::Facet f : facets) {
      std::ranges::sort(f);
      known_.insert(f);
    }
  }

  bool fill(const BorderLoop& loop) {
    std::vector<VertexId> rim(loop.vertices.rbegin(), loop.vertices.rend());  // against the facets
    if (rim.size() < 3) return false;
    if (against(rim) > 0) std::ranges::reverse(rim);
    const std::vector<TriMesh::Facet> triangles = triangles_for(rim);
    const FacetId first(facets_.size());
    for (TriMesh::Facet f : triangles) {
      std::ranges::sort(f);
      if (known_.contains(f)) return false;  // a triangle all by itself, not a hole
    }
    for (const TriMesh::Facet& f : triangles) facets_.push_back(f);
    if (rim.size() > 3) refine_patch(vertices_, facets_, first, facets_beside(first));
    for (FacetId t = first; t.index() < facets_.size(); t = FacetId(t.value + 1)) remember(t);
    return true;
  }

 private:
  /// Those before `first` that have a vertex with those from there on in common.
  std::vector<FacetId> facets_beside(FacetId first) const {
    std::vector<FacetId> result;
    for (FacetId t = first; t.index() < facets_.size(); t = FacetId(t.value + 1))
      for (const VertexId v : facets_[t])
        if (const auto known = at_vertex_.find(v); known != at_vertex_.end())
          result.insert(result.end(), known->second.begin(), known->second.end());
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  static Ends ends(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

  /// Sides that the facets across run through the same way as the rim, less those they run through as they
  /// should.
  long against(const std::vector<VertexId>& rim) const {
    long result = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const VertexId a = rim[i], b = rim[(i + 1) % rim.size()];
      const TriMesh::Facet& f = facets_[facet_at_.at(ends(a, b))];
      const auto at = static_cast<std::size_t>(std::ranges::find(f, a) - f.begin());
      result += f[(at + 1) % 3] == b ? 1 : -1;
    }
    return result;
  }

  /// Over the rim's vertices; if there is no way, around a new one in the middle.
  std::vector<TriMesh::Facet> triangles_for(const std::vector<VertexId>& rim) {
    std::vector<Vec3> corners, across;
    for (std::size_t i = 0; i < rim.size(); ++i) {
      corners.push_back(vertices_[rim[i]]);
      const auto& [a, b, c] = facets_[facet_at_.at(ends(rim[i], rim[(i + 1) % rim.size()]))];
      across.push_back((vertices_[b] - vertices_[a]).cross(vertices_[c] - vertices_[a]).normalized());
    }
    const auto forbidden = [&](std::size_t i, std::size_t j) {
      return count_.contains(ends(rim[i], rim[j]));
    };
    std::vector<TriMesh::Facet> result;
    for (const auto& [i, j, k] : filled({corners, across, forbidden}))
      result.push_back({rim[i], rim[j], rim[k]});
    if (!result.empty()) return result;
    Vec3 middle(0, 0, 0);
    for (const Vec3& p : corners) middle += p / static_cast<double>(corners.size());
    vertices_.push_back(middle);
    for (std::size_t i = 0; i < rim.size(); ++i)
      result.push_back({rim[i], rim[(i + 1) % rim.size()], VertexId(vertices_.size() - 1)});
    return result;
  }

  void remember(FacetId t) {
    TriMesh::Facet f = facets_[t];
    for (std::size_t e = 0; e < 3; ++e) {
      const Ends edge = ends(f[e], f[(e + 1) % 3]);
      ++count_[edge];
      facet_at_[edge] = t;
    }
    for (const VertexId v : f) at_vertex_[v].push_back(t);
    std::ranges::sort(f);
    known_.insert(f);
  }

  Table<VertexId, Vec3>& vertices_;
  Facets& facets_;
  std::map<Ends, int> count_;
  std::map<Ends, FacetId> facet_at_;  ///< the last one
  std::set<TriMesh::Facet> known_;    ///< corners ascending
  std::map<VertexId, std::vector<FacetId>> at_vertex_;
};

}  // namespace

HoleLimits usual_holes(double diagonal, double area) { return {0.5 * diagonal, 0.02 * area}; }

bool is_hole(const BorderLoop& loop, const HoleLimits& limits) {
  return loop.simple && (loop.length <= limits.length || loop.vector_area.norm() <= limits.area);
}

HoleFilling fill_holes(Table<VertexId, Vec3>& vertices, Facets& facets, const HoleLimits& limits) {
  HoleFilling result;
  const std::vector<BorderLoop> loops = border_loops(vertices, facets);
  if (loops.empty()) return result;
  const std::size_t facets_before = facets.size(), vertices_before = vertices.size();
  Filler filler(vertices, facets);
  for (const BorderLoop& loop : loops) {
    if (is_hole(loop, limits) && filler.fill(loop)) {
      ++result.filled;
    } else {
      ++result.left;
      result.longest_left = std::max(result.longest_left, loop.length);
    }
  }
  result.facets = facets.size() - facets_before;
  result.vertices = vertices.size() - vertices_before;
  return result;
}

}  // namespace geom
