#include "geom/repair/split.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "geom/disjoint_sets.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Facets = Table<FacetId, TriMesh::Facet>;
using Sides = std::span<const HalfEdge>;  ///< of one edge

constexpr int most_splittings = 32;
constexpr std::size_t most_sides = 64;  // of an edge of which all pairs are looked at

/// How well two facets at an edge go together: the smaller, the better.
struct Match {
  bool foreign;      ///< of two sheets
  bool misoriented;  ///< (of two sheets: along most of their seam)
  double bend;       ///< 0 if flat, 2 if one lies on the other (of two sheets: the mean)
  std::size_t a, b;  ///< sides
  auto key() const { return std::tuple(foreign, misoriented, bend, a, b); }
};

/// What is known of two sheets along their seam.
struct Seam {
  double length = 0, bend = 0, misoriented = 0;
};

/// Which facets stay joined across which edges, and so which corners share a vertex.
class Sheets {
 public:
  Sheets(const Table<VertexId, Vec3>& vertices, const Facets& facets)
      : vertices_(vertices),
        facets_(facets),
        half_edges_(sorted_half_edges(facets)),
        sheets_(facets.size()),
        corners_(3 * facets.size()),
        open_(3 * facets.size(), 0) {
    for_each_edge(half_edges_, [&](auto first, auto last) {
      if (last - first == 2) sheets_.merge_to_least(first[0].facet.index(), first[1].facet.index());
      if (last - first > 2) crowded_.push_back(Sides(first, last));
    });
    for (const Sides& sides : crowded_) survey(sides);
    for_each_edge(half_edges_, [&](auto first, auto last) {
      if (last - first == 1) mark_open(*first);
      if (last - first == 2) join(first[0], first[1]);
    });
    for (const Sides& sides : crowded_) pair_up(sides);
    for (std::size_t c = 0; c < open_.size(); ++c)
      if (open_[c]) open_[corners_.find(c)] = 1;
  }

  const std::vector<Sides>& crowded() const { return crowded_; }

  /// Facets by new vertices, those beyond the number of old ones copies of `copied`. `whole`: vertices all of
  /// whose fans part, too.
  Facets parted(Fans fans, const std::set<VertexId>& whole, std::vector<VertexId>& copied) {
    Facets result = facets_;
    std::map<std::pair<VertexId, std::size_t>, VertexId> names;
    Table<VertexId, char> taken(vertices_.size(), 0);
    for (FacetId t(0); t.index() < result.size(); t = FacetId(t.value + 1))
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId v = facets_[t][i];
        std::size_t fan = corners_.find(3 * t.index() + i);
        if (open_[fan] && fans == Fans::keep_open && !whole.contains(v)) fan = open_.size();
        const auto [entry, is_new] = names.try_emplace({v, fan}, v);
        if (is_new && taken[v]) {
          entry->second = VertexId(vertices_.size() + copied.size());
          copied.push_back(v);
        }
        taken[v] = 1;
        result[t][i] = entry->second;
      }
    return result;
  }

 private:
  std::size_t corner(const HalfEdge& h, VertexId v) const {
    const TriMesh::Facet& f = facets_[h.facet];
    return 3 * h.facet.index() + static_cast<std::size_t>(std::ranges::find(f, v) - f.begin());
  }
  void join(const HalfEdge& g, const HalfEdge& h) {
    for (const VertexId v : {g.low, g.high}) corners_.merge_to_least(corner(g, v), corner(h, v));
  }
  void mark_open(const HalfEdge& h) {
    for (const VertexId v : {h.low, h.high}) open_[corner(h, v)] = 1;
  }

  /// From the edge into the facet, at right angles to the edge.
  Vec3 inward(const HalfEdge& h) const {
    const Vec3 along = (vertices_[h.high] - vertices_[h.low]).normalized();
    const Vec3 across =
        vertices_[facets_[h.facet][static_cast<std::size_t>((h.edge + 2) % 3)]] - vertices_[h.low];
    return (across - across.dot(along) * along).normalized();
  }
  double bend(const HalfEdge& g, const HalfEdge& h) const { return 1 + inward(g).dot(inward(h)); }
  std::pair<std::size_t, std::size_t> sheets_of(const HalfEdge& g, const HalfEdge& h) {
    return std::minmax({sheets_.find(g.facet.index()), sheets_.find(h.facet.index())});
  }

  /// The pairs of sides, a < b, that may be joined: all, or, of very many, those next to each other around
  /// the edge or of one sheet.
  std::vector<std::pair<std::size_t, std::size_t>> candidates(const Sides& sides) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    if (sides.size() <= most_sides) {
      for (std::size_t a = 0; a < sides.size(); ++a)
        for (std::size_t b = a + 1; b < sides.size(); ++b) pairs.emplace_back(a, b);
      return pairs;
    }
    const Vec3 u = inward(sides[0]), v = (vertices_[sides[0].high] - vertices_[sides[0].low]).cross(u);
    std::vector<std::pair<double, std::size_t>> around, by_sheet;
    for (std::size_t a = 0; a < sides.size(); ++a) {
      const Vec3 d = inward(sides[a]);
      around.emplace_back(std::atan2(d.dot(v.normalized()), d.dot(u)), a);
      by_sheet.emplace_back(static_cast<double>(sheets_.find(sides[a].facet.index())), a);
    }
    for (auto* order : {&around, &by_sheet}) {
      std::ranges::sort(*order);
      for (std::size_t i = 0; i < order->size(); ++i)
        pairs.push_back(std::minmax({(*order)[i].second, (*order)[(i + 1) % order->size()].second}));
    }
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  void survey(const Sides& sides) {
    const double length = (vertices_[sides[0].high] - vertices_[sides[0].low]).norm();
    for (const auto& [a, b] : candidates(sides)) {
      Seam& seam = seams_[sheets_of(sides[a], sides[b])];
      seam.length += length;
      seam.bend += length * bend(sides[a], sides[b]);
      if (sides[a].ascending == sides[b].ascending) seam.misoriented += length;
    }
  }

  Match match(const Sides& sides, std::size_t a, std::size_t b) {
    const auto [s, t] = sheets_of(sides[a], sides[b]);
    if (s == t) return {false, sides[a].ascending == sides[b].ascending, bend(sides[a], sides[b]), a, b};
    const Seam& seam = seams_.at({s, t});
    const double length = seam.length > 0 ? seam.length : 1;
    return {true, 2 * seam.misoriented > length, seam.bend / length, a, b};
  }

  /// The best match first.
  void pair_up(const Sides& sides) {
    std::vector<Match> matches;
    for (const auto& [a, b] : candidates(sides)) matches.push_back(match(sides, a, b));
    std::ranges::sort(matches, {}, &Match::key);
    std::vector<char> paired(sides.size(), 0);
    for (const Match& m : matches) {
      if (paired[m.a] || paired[m.b]) continue;
      paired[m.a] = paired[m.b] = 1;
      join(sides[m.a], sides[m.b]);
    }
    std::vector<std::size_t> left;  // more than one only if not all pairs were candidates
    for (std::size_t a = 0; a < sides.size(); ++a)
      if (!paired[a]) left.push_back(a);
    for (std::size_t i = 0; i + 1 < left.size(); i += 2) join(sides[left[i]], sides[left[i + 1]]);
    if (left.size() % 2 == 1) mark_open(sides[left.back()]);
  }

  const Table<VertexId, Vec3>& vertices_;
  const Facets& facets_;
  std::vector<HalfEdge> half_edges_;
  std::vector<Sides> crowded_;
  DisjointSets sheets_, corners_;
  std::vector<char> open_;  ///< corners, then sets of them, that end at a border
  std::map<std::pair<std::size_t, std::size_t>, Seam> seams_;
};

std::vector<std::vector<HalfEdge>> crowded_edges(const Facets& facets) {
  std::vector<std::vector<HalfEdge>> result;
  const std::vector<HalfEdge> half_edges = sorted_half_edges(facets);
  for_each_edge(half_edges, [&](auto first, auto last) {
    if (last - first > 2) result.emplace_back(first, last);
  });
  return result;
}

/// Gives the last two facets at each crowded edge (or the one too many) a vertex in its middle; facets change
/// once. Returns how many vertices are new.
std::size_t part_in_the_middle(Table<VertexId, Vec3>& vertices, Facets& facets) {
  std::set<FacetId> changed;
  std::size_t added = 0;
  for (const std::vector<HalfEdge>& sides : crowded_edges(facets)) {
    const std::size_t first = sides.size() - (sides.size() == 3 ? 1 : 2);
    const std::span apart(sides.data() + first, sides.size() - first);
    if (std::ranges::any_of(apart, [&](const HalfEdge& h) { return changed.contains(h.facet); })) continue;
    vertices.push_back((vertices[sides[0].low] + vertices[sides[0].high]) / 2);
    const VertexId middle(vertices.size() - 1);
    ++added;
    for (const HalfEdge& h : apart) {
      changed.insert(h.facet);
      TriMesh::Facet other = facets[h.facet];
      facets[h.facet][static_cast<std::size_t>((h.edge + 1) % 3)] = middle;
      other[static_cast<std::size_t>(h.edge)] = middle;
      facets.push_back(other);
    }
  }
  return added;
}

}  // namespace

Splitting split_sheets(Table<VertexId, Vec3>& vertices, Facets& facets, Fans fans) {
  Splitting result;
  for (int round = 0; round < most_splittings; ++round) {
    Sheets sheets(vertices, facets);
    if (round == 0) result.edges = sheets.crowded().size();
    std::vector<VertexId> copied;
    Facets parted = sheets.parted(fans, {}, copied);
    std::set<VertexId> whole;
    for (const auto& sides : crowded_edges(parted))
      for (const VertexId v : {sides[0].low, sides[0].high})
        whole.insert(v.index() < vertices.size() ? v : copied[v.index() - vertices.size()]);
    if (!whole.empty()) {
      copied.clear();
      parted = sheets.parted(fans, whole, copied);
    }
    for (const VertexId v : copied) vertices.push_back(Vec3(vertices[v]));
    facets = std::move(parted);
    result.vertices += copied.size();
    const std::size_t added = part_in_the_middle(vertices, facets);
    result.vertices += added;
    if (added == 0) break;
  }
  return result;
}

}  // namespace geom
