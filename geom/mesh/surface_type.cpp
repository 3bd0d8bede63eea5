#include "geom/mesh/surface_type.h"

#include <algorithm>
#include <cstdint>

#include "geom/disjoint_sets.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

/// Which parts have a way round after which left is right: a facet and its mirror image, two nodes each, are
/// joined across edges of two facets as these run; where both come together the part is one-sided.
void find_one_sided(const std::vector<HalfEdge>& half_edges, SurfaceType& type) {
  const std::size_t count = type.part_of.size();
  DisjointSets sides(2 * count);
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first != 2) return;
    const std::size_t a = first[0].facet.index(), b = first[1].facet.index();
    const std::size_t turned = first[0].ascending == first[1].ascending ? count : 0;
    sides.merge(a, b + turned);
    sides.merge(a + count, b + (count - turned));
  });
  for (std::size_t t = 0; t < count; ++t)
    if (sides.find(t) == sides.find(t + count)) type.parts[type.part_of[FacetId(t)]].orientable = false;
}

/// Vertices and their borders, counted once in each part that they belong to.
void count_at_vertices(const TriMesh& mesh, const std::vector<HalfEdge>& half_edges, SurfaceType& type) {
  std::vector<std::uint64_t> corners;  // of parts: the part before the vertex
  const auto corner = [](std::size_t part, VertexId v) { return std::uint64_t{part} << 32 | v.index(); };
  corners.reserve(3 * mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh.facet(t)) corners.push_back(corner(type.part_of[t], v));
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const auto place = [&](std::size_t part, VertexId v) {
    return static_cast<std::size_t>(std::ranges::lower_bound(corners, corner(part, v)) - corners.begin());
  };
  for (const std::uint64_t c : corners) ++type.parts[c >> 32].euler;
  DisjointSets loops(corners.size());
  std::vector<char> on_border(corners.size(), 0);
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first != 1) return;
    const std::size_t part = type.part_of[first->facet];
    const std::size_t a = place(part, first->low), b = place(part, first->high);
    on_border[a] = on_border[b] = 1;
    loops.merge(a, b);
  });
  for (std::size_t i = 0; i < corners.size(); ++i)
    type.parts[corners[i] >> 32].border_loops += on_border[i] && loops.find(i) == i;
}

}  // namespace

SurfaceType surface_type(const TriMesh& mesh, const Topology& topology) {
  SurfaceType type;
  type.manifold = topology.manifold();
  const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh.facets());
  DisjointSets joined(mesh.num_facets());
  for_each_edge(half_edges, [&](auto first, auto last) {
    for (auto h = first + 1; h != last; ++h) joined.merge_to_least(first->facet.index(), h->facet.index());
  });
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
    const std::size_t first = joined.find(t);
    const bool is_new = first == t;
    type.part_of.push_back(is_new ? type.parts.size() : type.part_of[FacetId(first)]);
    if (is_new) type.parts.emplace_back();
    ++type.parts[type.part_of.back()].euler;
  }
  for_each_edge(half_edges, [&](auto first, auto) { --type.parts[type.part_of[first->facet]].euler; });
  count_at_vertices(mesh, half_edges, type);
  find_one_sided(half_edges, type);
  return type;
}

}  // namespace geom
