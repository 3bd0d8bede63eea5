#include "fpo/remesh/stand_in.h"

#include <algorithm>
#include <limits>

#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/scaling.h"

namespace fpo {
namespace {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

constexpr double long_facet = 1, most_needles = 40;  // in spacings
constexpr double long_edge = 1.0 / 2, near = 1.0 / 50;
constexpr double most_stretch = 1.2;
constexpr int most_passes = 32;
constexpr std::size_t most_facets_at_vertex = 64;  // that is given up
constexpr double tries = 64;  // of what is near at first: that far, and twice as far each time

double longest_edge(const TriMesh& mesh, FacetId t) {
  double longest = 0;
  for (int e = 0; e < 3; ++e)
    longest = std::max(longest, (mesh.corner(t, e) - mesh.corner(t, e == 2 ? 0 : e + 1)).norm());
  return longest;
}

class Collapsing {
 public:
  Collapsing(const TriMesh& mesh, const VertexField& spacing, const StandInEdges& edges)
      : edges_(edges),
        positions_(mesh.vertices()),
        facets_(mesh.facets()),
        spacing_(spacing),
        gone_(facets_.size(), 0),
        at_(positions_.size()) {
    for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1))
      for (const VertexId v : facets_[t]) at_[v].push_back(t);
  }

  TriMesh run() {
    for (int pass = 0; pass < most_passes; ++pass)
      if (!collapse_all()) break;
    Table<FacetId, TriMesh::Facet> kept;
    for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1))
      if (!gone_[t]) kept.push_back(facets_[t]);
    return TriMesh(std::move(positions_), std::move(kept));
  }

 private:
  struct Neighbour {
    VertexId vertex;
    int facets;  ///< at the edge to it
  };

  bool collapse_all() {
    bool any = false;
    for (VertexId v(0); v.index() < positions_.size(); v = VertexId(v.value + 1)) {
      std::erase_if(at_[v], [&](FacetId t) { return gone_[t] != 0; });
      if (!at_[v].empty() && at_[v].size() <= most_facets_at_vertex) any |= collapse(v);
    }
    return any;
  }

  double distance(VertexId a, VertexId b) const { return (positions_[a] - positions_[b]).norm(); }

  /// Into the nearest of its neighbours that will do.
  bool collapse(VertexId v) {
    find_neighbours(v);
    std::ranges::sort(neighbours_, [&](const Neighbour& a, const Neighbour& b) {
      const double x = distance(v, a.vertex), y = distance(v, b.vertex);
      return x != y ? x < y : a.vertex < b.vertex;
    });
    for (const Neighbour& to : neighbours_) {
      if (!(distance(v, to.vertex) < edges_.collapsed * spacing_[v])) break;
      if (!keeps_type(v, to) || !keeps_shape(v, to.vertex)) continue;
      replace(v, to.vertex);
      return true;
    }
    return false;
  }

  void find_neighbours(VertexId v) {
    neighbours_.clear();
    for (const FacetId t : at_[v])
      for (const VertexId u : facets_[t]) {
        if (u == v) continue;
        const auto known = std::ranges::find(neighbours_, u, &Neighbour::vertex);
        if (known != neighbours_.end())
          ++known->facets;
        else
          neighbours_.push_back({u, 1});
      }
  }

  bool joined(VertexId a, VertexId b) const {
    return std::ranges::any_of(
        at_[a], [&](FacetId t) { return !gone_[t] && std::ranges::find(facets_[t], b) != facets_[t].end(); });
  }

  /// The facets at v are a disk, or a fan at a border that the edge belongs to, and no vertex is a neighbour
  /// of both but those across the edge.
  bool keeps_type(VertexId v, const Neighbour& to) const {
    std::ptrdiff_t border = 0, crowded = 0;
    for (const Neighbour& n : neighbours_) {
      border += n.facets == 1;
      crowded += n.facets > 2;
    }
    if (crowded > 0 || border > 2 || (border == 2 && to.facets != 1)) return false;
    if (neighbours_.size() != at_[v].size() + (border > 0 ? 1 : 0) || at_[v].size() < 2) return false;
    int common = 0;
    for (const Neighbour& n : neighbours_) common += n.vertex != to.vertex && joined(to.vertex, n.vertex);
    const auto across = static_cast<std::size_t>(to.facets);
    const std::size_t left = at_[v].size() - across + num_facets(to.vertex) - across;
    return common == to.facets && left >= (border > 0 ? 1 : 3);
  }
  std::size_t num_facets(VertexId v) const {
    return static_cast<std::size_t>(std::ranges::count_if(at_[v], [&](FacetId t) { return !gone_[t]; }));
  }

  bool keeps_shape(VertexId v, VertexId u) const {
    for (const Neighbour& n : neighbours_) {
      if (n.vertex == u) continue;
      const double before = distance(v, n.vertex), after = distance(u, n.vertex);
      const bool stretched = before > long_edge * spacing_[v] && after <= most_stretch * before;
      if (after > edges_.made * spacing_[v] && !stretched) return false;
      if (n.facets == 1 && !lies_near(v, {positions_[u], positions_[n.vertex], positions_[u]})) return false;
    }
    bool is_near = false;
    for (const FacetId t : at_[v]) {
      const std::array<Vec3, 3> old = corners(t, v, v), now = corners(t, v, u);
      if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;  // it goes
      const Vec3 m = (now[1] - now[0]).cross(now[2] - now[0]), n = (old[1] - old[0]).cross(old[2] - old[0]);
      if (!(m.dot(n) > 0.7 * m.norm() * n.norm())) return false;
      is_near = is_near || lies_near(v, now);
    }
    return is_near;
  }
  bool lies_near(VertexId v, const std::array<Vec3, 3>& q) const {
    const double most = near * spacing_[v];
    return geom::closest_point(positions_[v], q).distance2 <= most * most;
  }
  std::array<Vec3, 3> corners(FacetId t, VertexId from, VertexId to) const {
    std::array<Vec3, 3> q;
    for (std::size_t i = 0; i < 3; ++i) q[i] = positions_[facets_[t][i] == from ? to : facets_[t][i]];
    return q;
  }

  void replace(VertexId v, VertexId u) {
    for (const FacetId t : at_[v]) {
      TriMesh::Facet& f = facets_[t];
      if (std::ranges::find(f, u) != f.end()) {
        gone_[t] = 1;
        continue;
      }
      std::ranges::replace(f, v, u);
      at_[u].push_back(t);
    }
    at_[v].clear();
  }

  StandInEdges edges_;
  Table<VertexId, Vec3> positions_;
  Table<FacetId, TriMesh::Facet> facets_;
  const VertexField& spacing_;
  Table<FacetId, char> gone_;
  Table<VertexId, std::vector<FacetId>> at_;  ///< some may be gone
  std::vector<Neighbour> neighbours_;         ///< of the vertex in hand
};

/// Where a facet is looked for, which way it is to face, and how far it may be.
struct Facing {
  Vec3 x, normal;
  double most;
};

/// The closest facet of those that face so, or of all if none is near.
geom::AabbTree::Closest closest_facing(const geom::AabbTree& tree, const TriMesh& surface,
                                       const Facing& facing) {
  const geom::AabbTree::Closest closest = tree.closest(facing.x);
  if (surface.normal(closest.facet).dot(facing.normal) >= 0) return closest;
  std::vector<FacetId> around;
  for (double r = facing.most / tries; r <= facing.most; r *= 2) {
    around.clear();
    tree.overlapping(geom::Box3(facing.x - Vec3::Constant(r), facing.x + Vec3::Constant(r)), around);
    std::ranges::sort(around);
    geom::AabbTree::Closest best;
    for (const FacetId t : around) {
      if (!(surface.normal(t).dot(facing.normal) > 0)) continue;
      const geom::TrianglePoint found = geom::closest_point(facing.x, tree.triangle(t));
      if (found.distance2 < best.distance2) best = {found, t};
    }
    if (best.distance2 <= r * r) return best;
  }
  return closest;
}

}  // namespace

bool has_needles(const TriMesh& surface, std::size_t n, double spacing) {
  double sum = 0;
  for (FacetId t(0); t.index() < surface.num_facets(); t = FacetId(t.value + 1)) {
    const double length = longest_edge(surface, t) / spacing;
    if (length > long_facet) sum += length;
  }
  return sum > most_needles * static_cast<double>(n);
}

TriMesh stand_in(const TriMesh& surface, const VertexField& spacing, const StandInEdges& edges) {
  return Collapsing(surface, spacing, edges).run();
}

TriMesh stand_in(const TriMesh& surface, double spacing) {
  return stand_in(surface, VertexField(surface.num_vertices(), spacing));
}

std::vector<SurfaceSample> brought_to(const TriMesh& surface, std::vector<SurfaceSample> samples) {
  const geom::AabbTree tree(surface);
  for (SurfaceSample& x : samples) {
    const geom::AabbTree::Closest closest = tree.closest(x.position);
    x = {geom::snapped(closest.point), closest.facet};
  }
  return samples;
}

std::vector<SurfaceSample> brought_to(const TriMesh& surface, std::vector<SurfaceSample> samples,
                                      const TriMesh& from) {
  const geom::AabbTree tree(surface);
  for (SurfaceSample& x : samples) {
    const Facing facing{x.position, from.normal(x.facet), longest_edge(from, x.facet) / 2};
    const geom::AabbTree::Closest closest = closest_facing(tree, surface, facing);
    x = {geom::snapped(closest.point), closest.facet};
  }
  return samples;
}

TriMesh with_vertices_at(const std::vector<SurfaceSample>& samples, const TriMesh& remesh) {
  geom::Table<VertexId, Vec3> positions;
  for (const SurfaceSample& x : samples) positions.push_back(x.position);
  return TriMesh(std::move(positions), remesh.facets());
}

}  // namespace fpo
