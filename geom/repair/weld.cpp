#include "geom/repair/weld.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "geom/check.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

constexpr int most_rounds = 64;            // then nothing is welded: there is no end in sight
constexpr double cos_folded = 0.99985;     // of a degree
constexpr double beyond_rounding = 16;     // in tolerances
constexpr std::size_t pairs_a_facet = 32;  // of vertices that are near: more is a crowd

/// An edge of one facet, by the places of its ends.
struct BorderEdge {
  VertexId low, high;        ///< places, ascending
  VertexId at_low, at_high;  ///< the vertices there
  FacetId facet;

  auto ends() const { return std::pair(low, high); }
};

/// Those of one pair of places next to each other; edges whose ends share a place are left out.
std::vector<BorderEdge> border_edges(const std::vector<HalfEdge>& half_edges, const Places& places) {
  std::vector<BorderEdge> result;
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first != 1) return;
    BorderEdge edge{places[first->low], places[first->high], first->low, first->high, first->facet};
    if (edge.low == edge.high) return;
    if (edge.high < edge.low) std::swap(edge.low, edge.high), std::swap(edge.at_low, edge.at_high);
    result.push_back(edge);
  });
  std::ranges::stable_sort(result, {}, &BorderEdge::ends);
  return result;
}

/// Half-edges by the edges that they make: the facets `before`, whose vertices are now called otherwise.
bool was_one_edge(const Facets& before, std::span<const HalfEdge> now) {
  const auto ends = [&](const HalfEdge& h) {
    const TriMesh::Facet& f = before[h.facet];
    const VertexId a = f[static_cast<std::size_t>(h.edge)], b = f[static_cast<std::size_t>((h.edge + 1) % 3)];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  return std::ranges::all_of(now, [&](const HalfEdge& h) { return ends(h) == ends(now.front()); });
}

/// Do two facets lie on one another, and not on both sides of the edge that they are to share?
bool are_folded(const BorderEdge& a, const BorderEdge& b, const Facets& facets,
                const Table<VertexId, Vec3>& vertices) {
  const auto away = [&](const BorderEdge& e) {
    const Vec3 along = (vertices[e.at_high] - vertices[e.at_low]).normalized();
    Vec3 result(0, 0, 0);
    for (const VertexId v : facets[e.facet]) {
      const Vec3 d = vertices[v] - vertices[e.at_low];
      if (v != e.at_low && v != e.at_high) result = d - d.dot(along) * along;
    }
    return Vec3(result.normalized());
  };
  return away(a).dot(away(b)) > cos_folded;
}

/// One attempt; `blocked`: places where nothing is welded.
Welding welded(const std::vector<BorderEdge>& edges, const std::set<VertexId>& blocked, Crowds crowds,
               std::size_t num_vertices, Facets& facets) {
  Welding result;
  DisjointSets vertices(num_vertices);
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last =
        std::find_if(first, edges.end(), [&](const BorderEdge& e) { return e.ends() != first->ends(); });
    const auto count = static_cast<std::size_t>(last - first);
    const bool may = !blocked.contains(first->low) && !blocked.contains(first->high);
    if (count == 2 ? may : count > 2 && crowds == Crowds::weld) {
      for (auto e = first + 1; e != last; ++e) {
        vertices.merge_to_least(first->at_low.index(), e->at_low.index());
        vertices.merge_to_least(first->at_high.index(), e->at_high.index());
      }
      result.pairs += count - 1;
    } else if (count > 1) {
      result.crowded += count;
    }
    first = last;
  }
  for (TriMesh::Facet& f : facets)
    for (VertexId& v : f) v = VertexId(vertices.find(v.index()));
  return result;
}

/// Takes pairs of such facets out.
void leave_folded(const Table<VertexId, Vec3>& vertices, const Facets& facets,
                  std::vector<BorderEdge>& edges) {
  std::vector<BorderEdge> kept;
  for (auto first = edges.begin(), last = first; first != edges.end(); first = last) {
    last = std::find_if(first, edges.end(), [&](const BorderEdge& e) { return e.ends() != first->ends(); });
    if (last - first != 2 || !are_folded(*first, *(first + 1), facets, vertices))
      kept.insert(kept.end(), first, last);
  }
  edges = std::move(kept);
}

/// Places where welding has brought foreign edges together.
std::set<VertexId> conflicts(const Facets& before, const Facets& after, const Places& places) {
  std::set<VertexId> result;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(after);
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first <= 2 || was_one_edge(before, std::span(first, last))) return;
    result.insert(places[first->low]);
    result.insert(places[first->high]);
  });
  return result;
}

/// The borders of a mesh and what is left of them when they are welded.
struct Borders {
  std::size_t edges = 0, all = 0;  ///< with one facet; of any number
  double median = 0;               ///< their length
};

Borders borders_of(const Table<VertexId, Vec3>& vertices, const Facets& facets) {
  Borders result;
  std::vector<double> lengths;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
  for_each_edge(half_edges, [&](auto first, auto last) {
    ++result.all;
    if (last - first == 1) lengths.push_back((vertices[first->low] - vertices[first->high]).norm());
  });
  result.edges = lengths.size();
  if (lengths.empty()) return result;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  result.median = *middle;
  return result;
}

/// A share of the diagonal, but at most a hundredth of the median border edge.
double small_beside(const Borders& borders, double share, const Table<VertexId, Vec3>& vertices,
                    const Facets& facets) {
  Box3 box;
  for (const TriMesh::Facet& f : facets)
    for (const VertexId v : f) box.extend(vertices[v]);
  const double small = share * box.diagonal().norm();
  return borders.edges == 0 ? small : std::min(small, 0.01 * borders.median);
}

/// What there is when borders are welded.
struct Left {
  std::size_t borders = 0, pieces = 0;  ///< edges; sets of facets that hang together by vertices
};

Left left_by(const Table<VertexId, Vec3>& vertices, Facets facets, double tolerance) {
  weld_borders(near_places(vertices, facets, tolerance), facets, Crowds::weld);
  DisjointSets sets(vertices.size());
  std::set<std::size_t> pieces;
  for (const TriMesh::Facet& f : facets)
    for (const VertexId v : f) sets.merge(f[0].index(), v.index());
  for (const TriMesh::Facet& f : facets) pieces.insert(sets.find(f[0].index()));
  return {borders_of(vertices, facets).edges, pieces.size()};
}

}  // namespace

// Pairs weld ends, and ends that are welded may make one edge of two that lie between them. Then nothing is
// welded there, and all is done again: each round blocks a place more.
Welding weld_borders(const Places& places, Facets& facets, Crowds crowds,
                     const Table<VertexId, Vec3>* vertices) {
  std::vector<BorderEdge> edges = border_edges(sorted_half_edges(facets), places);
  if (vertices) leave_folded(*vertices, facets, edges);
  std::set<VertexId> blocked;
  for (int round = 0;; ++round) {
    if (round == most_rounds)
      for (const BorderEdge& e : edges) blocked.insert({e.low, e.high});
    Facets trial = facets;
    const Welding result = welded(edges, blocked, crowds, places.size(), trial);
    if (result.pairs == 0) return result;
    if (crowds == Crowds::leave) {
      const std::size_t known = blocked.size();
      blocked.merge(conflicts(facets, trial, places));
      if (blocked.size() > known) continue;
    }
    facets = std::move(trial);
    return result;
  }
}

Welding weld_rounded(const Table<VertexId, Vec3>& vertices, Facets& facets) try {
  const Borders borders = borders_of(vertices, facets);
  if (borders.edges == 0) return {};
  const double tolerance = small_beside(borders, 0x1p-22, vertices, facets);
  const auto weld_within = [&](double distance, Facets& welded) {
    const Places places = near_places(vertices, welded, distance, pairs_a_facet * welded.size());
    return weld_borders(places, welded, Crowds::leave, &vertices);
  };
  Facets farther = facets, near = facets;
  const std::size_t would_be = weld_within(beyond_rounding * tolerance, farther).pairs;
  if (would_be == 0) return {};
  const Welding result = weld_within(tolerance, near);
  if (result.pairs != would_be) return {};
  facets = std::move(near);
  return result;
} catch (const InputError&) {  // a crowd
  return {};
}

double usual_tolerance(const Table<VertexId, Vec3>& vertices, const Facets& facets) {
  const Borders borders = borders_of(vertices, facets);
  double tolerance = small_beside(borders, 1e-6, vertices, facets);
  if (borders.edges == 0) return tolerance;
  if (10 * borders.edges <= borders.all) return tolerance;
  const Left first = left_by(vertices, facets, tolerance);
  Left left = first;
  try {
    for (double wider = 10 * tolerance; left.borders > 0 && wider < 0.1 * borders.median; wider *= 10) {
      const Left next = left_by(vertices, facets, wider);
      if (2 * next.borders > left.borders || 2 * next.pieces > first.pieces) continue;
      tolerance = wider;
      left = next;
    }
  } catch (const InputError&) {  // it reaches over most vertices
  }
  return tolerance;
}

double wider_tolerance(const Table<VertexId, Vec3>& vertices, const Facets& facets, double unit) try {
  constexpr std::size_t few = 8;
  const Borders borders = borders_of(vertices, facets);
  if (borders.edges < few) return 0;
  const auto left = [&](double tolerance) { return left_by(vertices, facets, tolerance).borders; };
  const double widest = 0.2 * borders.median;
  const std::size_t least = left(widest);
  if (2 * least > borders.edges) return 0;
  const double usual = usual_tolerance(vertices, facets);
  if (2 * left(usual) <= borders.edges) return 0;
  for (double ten = unit * std::pow(10, std::floor(std::log10(usual / unit))); ten <= widest; ten *= 10)
    for (const double tolerance : {ten, 2 * ten, 5 * ten}) {
      if (tolerance <= usual || tolerance > widest) continue;
      if (10 * left(tolerance) <= 10 * least + borders.edges) return tolerance;
    }
  return 0;
} catch (const InputError&) {  // it reaches over most vertices
  return 0;
}

}  // namespace geom
