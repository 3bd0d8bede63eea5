#pragma once
// The edges of facets, sorted so that those of one edge come together.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "geom/ids.h"

namespace geom {

/// One side of an edge: the facet and which of its edges.
struct HalfEdge {
  VertexId low, high;  ///< ends, ascending
  FacetId facet;
  int edge;
  bool ascending;  ///< the facet runs from low to high

  auto ends() const { return std::pair(low, high); }
  VertexId from() const { return ascending ? low : high; }
  VertexId to() const { return ascending ? high : low; }
};

/// All half-edges, those of one edge next to each other, in order of facets. O(F log F).
inline std::vector<HalfEdge> sorted_half_edges(const Table<FacetId, std::array<VertexId, 3>>& facets) {
  std::vector<HalfEdge> result;
  result.reserve(3 * facets.size());
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const VertexId a = facets[t][static_cast<std::size_t>(e)],
                     b = facets[t][static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
      result.push_back({std::min(a, b), std::max(a, b), t, e, a < b});
    }
  std::ranges::stable_sort(result, {}, &HalfEdge::ends);
  return result;
}

/// Calls visit(first, last) for the half-edges of each edge.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& half_edges, Visit visit) {
  for (auto first = half_edges.begin(); first != half_edges.end();) {
    const auto last =
        std::find_if(first, half_edges.end(), [&](const HalfEdge& h) { return h.ends() != first->ends(); });
    visit(first, last);
    first = last;
  }
}

/// How many facets have the edge from a to b, in either direction. O(log F).
inline std::size_t num_facets_at(const std::vector<HalfEdge>& half_edges, VertexId a, VertexId b) {
  const auto found =
      std::ranges::equal_range(half_edges, std::pair(std::min(a, b), std::max(a, b)), {}, &HalfEdge::ends);
  return found.size();
}

}  // namespace geom
