#pragma once
// The edges of facets, sorted so that those of one edge come together.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "geom/ids.h"

namespace geom {

/// One side of an edge: the facet and which of its edges.
struct HalfEdge {
  VertexId low, high;  ///< ends, ascending
  FacetId facet;
  std::int8_t edge;
  bool ascending;  ///< the facet runs from low to high

  auto ends() const { return std::pair(low, high); }
  VertexId from() const { return ascending ? low : high; }
  VertexId to() const { return ascending ? high : low; }
};

/// All half-edges, those of one edge next to each other, in order of facets. O(F), and for each vertex its
/// higher neighbours sorted.
inline std::vector<HalfEdge> sorted_half_edges(const Table<FacetId, std::array<VertexId, 3>>& facets) {
  const auto half_edge = [&](FacetId t, int e) -> HalfEdge {
    const VertexId a = facets[t][static_cast<std::size_t>(e)],
                   b = facets[t][static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
    return {std::min(a, b), std::max(a, b), t, static_cast<std::int8_t>(e), a < b};
  };
  const auto for_each = [&](auto visit) {
    for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
      for (int e = 0; e < 3; ++e) visit(half_edge(t, e));
  };
  std::vector<std::size_t> first;  // of each lower end
  for_each([&](const HalfEdge& h) {
    if (h.low.index() + 2 > first.size()) first.resize(h.low.index() + 2, 0);
    ++first[h.low.index() + 1];
  });
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<HalfEdge> result(3 * facets.size());
  std::vector<std::size_t> next = first;
  for_each([&](const HalfEdge& h) { result[next[h.low.index()]++] = h; });
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    const auto begin = result.begin() + static_cast<std::ptrdiff_t>(first[v]),
               end = result.begin() + static_cast<std::ptrdiff_t>(first[v + 1]);
    std::sort(begin, end, [](const HalfEdge& a, const HalfEdge& b) {
      return std::tuple(a.high, a.facet, a.edge) < std::tuple(b.high, b.facet, b.edge);
    });
  }
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

/// Those of the edge from a to b, in either direction. O(log F).
inline std::span<const HalfEdge> half_edges_at(const std::vector<HalfEdge>& half_edges, VertexId a,
                                               VertexId b) {
  const std::pair ends(std::min(a, b), std::max(a, b));
  return {std::ranges::lower_bound(half_edges, ends, {}, &HalfEdge::ends),
          std::ranges::upper_bound(half_edges, ends, {}, &HalfEdge::ends)};
}

/// How many facets have that edge. O(log F).
inline std::size_t num_facets_at(const std::vector<HalfEdge>& half_edges, VertexId a, VertexId b) {
  return half_edges_at(half_edges, a, b).size();
}

}  // namespace geom
