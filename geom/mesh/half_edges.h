#pragma once
// The edges of facets, sorted so that those of one edge come together.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
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

inline HalfEdge half_edge(const Table<FacetId, std::array<VertexId, 3>>& facets, FacetId t, int e) {
  const VertexId a = facets[t][static_cast<std::size_t>(e)],
                 b = facets[t][static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
  return {std::min(a, b), std::max(a, b), t, static_cast<std::int8_t>(e), a < b};
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

/// The same for all edges of facets, ascending by their ends; each edge's half-edges in order of facets.
/// O(F), and for each vertex its higher neighbours sorted; four bytes a half-edge are all that it keeps.
template <class Visit>
void for_each_edge(const Table<FacetId, std::array<VertexId, 3>>& facets, Visit visit) {
  const auto all = [&](auto take) {
    for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
      for (int e = 0; e < 3; ++e) take(half_edge(facets, t, e));
  };
  std::vector<std::uint32_t> end;  // of those of each lower end
  all([&](const HalfEdge& h) {
    if (h.low.index() + 2 > end.size()) end.resize(h.low.index() + 2, 0);
    ++end[h.low.index() + 1];
  });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::uint32_t> numbers(3 * facets.size());
  all([&](const HalfEdge& h) {
    numbers[end[h.low.index()]++] =
        static_cast<std::uint32_t>(3 * h.facet.index()) + static_cast<std::uint32_t>(h.edge);
  });
  std::vector<HalfEdge> of_one;
  std::uint32_t begin = 0;
  for (const std::uint32_t e : end) {
    of_one.clear();
    for (; begin < e; ++begin)
      of_one.push_back(
          half_edge(facets, FacetId(std::size_t{numbers[begin] / 3}), static_cast<int>(numbers[begin] % 3)));
    std::ranges::sort(of_one, {}, [](const HalfEdge& h) { return std::tuple(h.high, h.facet, h.edge); });
    for_each_edge(of_one, visit);
  }
}

/// All half-edges, those of one edge next to each other, in that order.
inline std::vector<HalfEdge> sorted_half_edges(const Table<FacetId, std::array<VertexId, 3>>& facets) {
  std::vector<HalfEdge> result;
  result.reserve(3 * facets.size());
  for_each_edge(facets, [&](auto first, auto last) { result.insert(result.end(), first, last); });
  return result;
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
