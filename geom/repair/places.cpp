#include "geom/repair/places.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "geom/check.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/half_edges.h"

namespace geom {
namespace {

using Cell = std::array<double, 3>;  // whole numbers

/// Vertices by the cubes of a grid in which they lie.
class Grid {
 public:
  Grid(const Table<VertexId, Vec3>& vertices, const std::vector<VertexId>& some, double width)
      : vertices_(vertices), width_(width) {
    for (const VertexId v : some) entries_.push_back({cell(vertices[v]), v});
    std::ranges::sort(entries_);
  }

  /// Calls visit(u) for all vertices in the cubes within `reach` of p, less than a cube's width.
  template <class Visit>
  void near(const Vec3& p, double reach, Visit visit) const {
    const Cell low = cell(p - Vec3::Constant(reach)), high = cell(p + Vec3::Constant(reach));
    // Two cubes on each axis at most, for the reach is less than a cube's width. (Far out there is no next
    // number.)
    for (int corner = 0; corner < 8; ++corner) {
      Cell at = low;
      bool is_new = true;
      for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if ((corner >> axis & 1) == 0) continue;
        is_new = is_new && high[i] != low[i];
        at[i] = high[i];
      }
      if (!is_new) continue;
      for (auto entry = std::ranges::lower_bound(entries_, at, {}, &Entry::cell);
           entry != entries_.end() && entry->cell == at; ++entry)
        visit(entry->vertex);
    }
  }

 private:
  struct Entry {
    Cell cell;
    VertexId vertex;
    auto operator<=>(const Entry&) const = default;
  };
  Cell cell(const Vec3& p) const {
    return {std::floor(p.x() / width_), std::floor(p.y() / width_), std::floor(p.z() / width_)};
  }

  const Table<VertexId, Vec3>& vertices_;
  double width_;
  std::vector<Entry> entries_;
};

/// The places of border vertices.
std::vector<VertexId> border_places(const Places& places, const Table<FacetId, TriMesh::Facet>& facets) {
  std::vector<VertexId> result;
  for_each_edge(facets, [&](auto first, auto last) {
    if (last - first != 1) return;
    result.push_back(places[first->low]);
    result.push_back(places[first->high]);
  });
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

struct Pair {
  double distance;
  VertexId a, b;
  auto operator<=>(const Pair&) const = default;
};

std::vector<Pair> pairs_within(double tolerance, const Table<VertexId, Vec3>& vertices,
                               const std::vector<VertexId>& some, std::size_t most_pairs) {
  const Grid grid(vertices, some, 4 * tolerance);
  std::vector<Pair> pairs;
  for (const VertexId a : some)
    grid.near(vertices[a], tolerance, [&](VertexId b) {
      const double distance = (vertices[a] - vertices[b]).norm();
      if (!(a < b && distance <= tolerance)) return;
      require(pairs.size() < most_pairs,
              "borders are welded over too many vertices: the tolerance is too large");
      pairs.push_back({distance, a, b});
    });
  std::ranges::sort(pairs);
  return pairs;
}

/// The facets at each place, ascending.
using FacetsAt = Table<VertexId, std::vector<FacetId>>;

bool have_common(const std::vector<FacetId>& a, const std::vector<FacetId>& b) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) return true;
    *i < *j ? ++i : ++j;
  }
  return false;
}

}  // namespace

Places exact_places(const Table<VertexId, Vec3>& vertices) {
  std::vector<VertexId> order(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = VertexId(i);
  const auto key = [&](VertexId v) {
    const Vec3& p = vertices[v];
    return std::tuple(p.x(), p.y(), p.z(), v);
  };
  std::ranges::sort(order, [&](VertexId a, VertexId b) { return key(a) < key(b); });
  Places places(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    places[order[i]] =
        i > 0 && vertices[order[i]] == vertices[order[i - 1]] ? places[order[i - 1]] : order[i];
  return places;
}

Places near_places(const Table<VertexId, Vec3>& vertices, const Table<FacetId, TriMesh::Facet>& facets,
                   double tolerance, std::size_t most_pairs) {
  Places places = exact_places(vertices);
  if (!(tolerance > 0)) return places;
  FacetsAt facets_at(vertices.size());
  for (FacetId t(0); t.index() < facets.size(); t = FacetId(t.value + 1))
    for (const VertexId v : facets[t]) {
      std::vector<FacetId>& there = facets_at[places[v]];
      if (there.empty() || there.back() != t) there.push_back(t);
    }
  DisjointSets clusters(vertices.size());
  std::set<std::pair<VertexId, VertexId>> refused;  // they have a facet in common, and will
  for (const Pair& pair : pairs_within(tolerance, vertices, border_places(places, facets), most_pairs)) {
    const VertexId a(clusters.find(pair.a.index())), b(clusters.find(pair.b.index()));
    if (a == b || refused.contains(std::minmax(a, b))) continue;
    if (have_common(facets_at[a], facets_at[b])) {
      refused.insert(std::minmax(a, b));
      continue;
    }
    clusters.merge_to_least(a.index(), b.index());
    std::vector<FacetId> both;
    std::ranges::merge(facets_at[a], facets_at[b], std::back_inserter(both));
    facets_at[std::min(a, b)] = std::move(both);
    facets_at[std::max(a, b)].clear();
  }
  for (VertexId& place : places) place = VertexId(clusters.find(place.index()));
  return places;
}

}  // namespace geom
