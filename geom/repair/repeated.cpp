#include "geom/repair/repeated.h"

#include <algorithm>

#include "geom/disjoint_sets.h"
#include "geom/mesh/half_edges.h"
#include "geom/repair/flat_facets.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

struct Keyed {
  TriMesh::Facet key;  ///< its corners, ascending
  FacetId facet;
  auto operator<=>(const Keyed&) const = default;
};

/// Facets of the same corners next to each other, in order.
template <class Name>
std::vector<Keyed> by_corners(const Facets& facets, Name name) {
  std::vector<Keyed> result;
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1)) {
    TriMesh::Facet key = facets[t];
    for (VertexId& v : key) v = name(v);
    std::ranges::sort(key);
    result.push_back({key, t});
  }
  std::ranges::sort(result);
  return result;
}

/// For each facet the first of its part.
Table<FacetId, FacetId> parts(const Facets& facets) {
  DisjointSets sets(facets.size());
  const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
  for_each_edge(half_edges, [&](auto first, auto last) {
    for (auto h = first + 1; h != last; ++h) sets.merge_to_least(first->facet.index(), h->facet.index());
  });
  Table<FacetId, FacetId> result;
  for (std::size_t t = 0; t < facets.size(); ++t) result.push_back(FacetId(sets.find(t)));
  return result;
}

bool is_even(const TriMesh::Facet& f) { return (f[0] < f[1]) + (f[1] < f[2]) + (f[2] < f[0]) == 2; }

/// Those that are there twice, once each way.
Table<FacetId, char> facets_both_ways(const Facets& facets) {
  const std::vector<Keyed> sorted = by_corners(facets, [](VertexId v) { return v; });
  Table<FacetId, char> both(facets.size(), 0);
  for (std::size_t i = 0, next = 0; i < sorted.size(); i = next) {
    while (next < sorted.size() && sorted[next].key == sorted[i].key) ++next;
    if (next - i == 2 && is_even(facets[sorted[i].facet]) != is_even(facets[sorted[i + 1].facet]))
      both[sorted[i].facet] = both[sorted[i + 1].facet] = 1;
  }
  return both;
}

}  // namespace

std::size_t drop_walls(Facets& facets) {
  Table<FacetId, char> marked = facets_both_ways(facets);
  if (std::ranges::count(marked, 1) == 0) return 0;
  DisjointSets patches(facets.size());
  const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
  const auto in_patch = [&](const HalfEdge& h) { return marked[h.facet] != 0; };
  for_each_edge(half_edges, [&](auto first, auto last) {
    const auto one = std::find_if(first, last, in_patch);
    for (auto h = one; h != last; ++h)
      if (in_patch(*h)) patches.merge_to_least(one->facet.index(), h->facet.index());
  });
  std::vector<char> has_rim(facets.size(), 0), is_none(facets.size(), 0);  // by the first facet of a patch
  for_each_edge(half_edges, [&](auto first, auto last) {
    const auto members = std::count_if(first, last, in_patch), others = last - first - members;
    if (members == 0 || (members > 2 && others == 0)) return;
    const std::size_t patch = patches.find(std::find_if(first, last, in_patch)->facet.index());
    has_rim[patch] = 1;
    if (members != 2 || others < 2 || others % 2 != 0) is_none[patch] = 1;
  });
  for (std::size_t t = 0; t < facets.size(); ++t) {
    const std::size_t patch = patches.find(t);
    if (marked[FacetId(t)] && (!has_rim[patch] || is_none[patch])) marked[FacetId(t)] = 0;
  }
  const auto count = static_cast<std::size_t>(std::ranges::count(marked, 1));
  if (count > 0) drop_marked(marked, facets);
  return count;
}

std::size_t drop_repeated(Facets& facets) {
  const std::vector<Keyed> sorted = by_corners(facets, [](VertexId v) { return v; });
  Table<FacetId, char> marked(facets.size(), 0);
  std::size_t count = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].key == sorted[i - 1].key) marked[sorted[i].facet] = 1, ++count;
  if (count > 0) drop_marked(marked, facets);
  return count;
}

// Parts in the order of their first facets: each is held against those that are kept.
std::size_t drop_doubled(const Places& places, Facets& facets) {
  const std::vector<Keyed> sorted = by_corners(facets, [&](VertexId v) { return places[v]; });
  const auto repeats = [&](std::size_t i) { return i > 0 && sorted[i].key == sorted[i - 1].key; };
  bool any = false;
  for (std::size_t i = 1; i < sorted.size(); ++i) any = any || repeats(i);
  if (!any) return 0;

  const Table<FacetId, FacetId> part = parts(facets);
  Table<FacetId, std::size_t> run(facets.size());  // where the facets of its corners begin in `sorted`
  for (std::size_t i = 0, first = 0; i < sorted.size(); ++i)
    run[sorted[i].facet] = first = repeats(i) ? first : i;
  Table<FacetId, std::vector<FacetId>> members(facets.size());
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1)) members[part[t]].push_back(t);

  Table<FacetId, char> marked(facets.size(), 0);
  const auto lies_on_another = [&](FacetId t) {
    for (std::size_t i = run[t]; i < sorted.size() && (i == run[t] || repeats(i)); ++i)
      if (part[sorted[i].facet] < part[t] && !marked[sorted[i].facet]) return true;
    return false;
  };
  std::size_t count = 0;
  for (const std::vector<FacetId>& facets_of_part : members) {
    if (facets_of_part.empty() || !std::ranges::all_of(facets_of_part, lies_on_another)) continue;
    for (const FacetId t : facets_of_part) marked[t] = 1;
    count += facets_of_part.size();
  }
  drop_marked(marked, facets);
  return count;
}

}  // namespace geom
