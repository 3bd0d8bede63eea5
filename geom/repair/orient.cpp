#include "geom/repair/orient.h"

#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;

constexpr std::size_t most_parts_compared = 2000;

/// The facets joined to one another.
struct Part {
  std::vector<FacetId> facets;
  bool closed = true, two_sided = true;
  std::size_t turned = 0;
  double volume = 0;
  Box3 box;
};

/// A facet beside another one.
struct Neighbour {
  FacetId facet;
  bool agrees;  ///< in orientation
};

using Neighbours = Table<FacetId, std::array<Neighbour, 3>>;

Neighbours neighbours_of(const Facets& facets) {
  Neighbours result(facets.size());
  const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first != 2) return;
    const bool agree = first[0].ascending != first[1].ascending;
    result[first[0].facet][static_cast<std::size_t>(first[0].edge)] = {first[1].facet, agree};
    result[first[1].facet][static_cast<std::size_t>(first[1].edge)] = {first[0].facet, agree};
  });
  return result;
}

/// Walks over the part of `start`; `turn` says of each facet whether it is to be turned: 0 no, 1 yes, -1 not
/// known.
Part walk(FacetId start, const Neighbours& neighbours, Table<FacetId, signed char>& turn) {
  Part part;
  part.facets.push_back(start);
  turn[start] = 0;
  for (std::size_t i = 0; i < part.facets.size(); ++i) {
    const FacetId t = part.facets[i];
    for (const Neighbour& n : neighbours[t]) {
      if (!n.facet.valid()) {
        part.closed = false;
        continue;
      }
      const auto wanted = static_cast<signed char>(n.agrees ? turn[t] : 1 - turn[t]);
      if (turn[n.facet] < 0) {
        turn[n.facet] = wanted;
        part.facets.push_back(n.facet);
      } else if (turn[n.facet] != wanted) {
        part.two_sided = false;
      }
    }
  }
  for (const FacetId t : part.facets) part.turned += turn[t] > 0;
  if (2 * part.turned <= part.facets.size()) return part;
  for (const FacetId t : part.facets) turn[t] = static_cast<signed char>(1 - turn[t]);
  part.turned = part.facets.size() - part.turned;
  return part;
}

void measure(Part& part, const Table<VertexId, Vec3>& vertices, const Facets& facets,
             const Table<FacetId, signed char>& turn) {
  for (const FacetId t : part.facets)
    for (const VertexId v : facets[t]) part.box.extend(vertices[v]);
  const Vec3 middle = part.box.center();
  for (const FacetId t : part.facets) {
    const Vec3 a = vertices[facets[t][0]] - middle, b = vertices[facets[t][1]] - middle,
               c = vertices[facets[t][2]] - middle;
    part.volume += (turn[t] > 0 ? -1 : 1) * a.cross(b).dot(c);
  }
}

bool lies_inside(const Part& part, const std::vector<Part>& parts) {
  if (parts.size() > most_parts_compared) return false;
  for (const Part& other : parts)
    if (&other != &part && other.closed && (other.box.min().array() < part.box.min().array()).all() &&
        (other.box.max().array() > part.box.max().array()).all())
      return true;
  return false;
}

}  // namespace

Orientation orient(const Table<VertexId, Vec3>& vertices, Facets& facets) {
  const Neighbours neighbours = neighbours_of(facets);
  Table<FacetId, signed char> turn(facets.size(), -1);
  std::vector<Part> parts;
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1)) {
    if (turn[t] >= 0) continue;
    parts.push_back(walk(t, neighbours, turn));
    measure(parts.back(), vertices, facets, turn);
  }
  Orientation result;
  for (const Part& part : parts) {
    result.one_sided += !part.two_sided;
    result.inverted += part.turned;
    if (!part.closed || !part.two_sided || !(part.volume < 0)) continue;
    if (part.turned == 0 && lies_inside(part, parts)) {
      ++result.parts_left_inside;
      continue;
    }
    ++result.parts_turned;
    for (const FacetId t : part.facets) turn[t] = static_cast<signed char>(1 - turn[t]);
  }
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
    if (turn[t] > 0) {
      std::swap(facets[t][1], facets[t][2]);
      ++result.turned;
    }
  return result;
}

}  // namespace geom
