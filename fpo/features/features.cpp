#include "fpo/features/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "geom/mesh/angles.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// An edge of the mesh with what its facets say about it.
struct Edge {
  std::array<VertexId, 2> ends;  ///< ascending
  FacetId facet;                 ///< the smallest
  std::size_t sheets;            ///< facets
  double fold;                   ///< between the normals of two facets, in degrees; 360: it is marked
};

using Normals = geom::Table<FacetId, Vec3>;

/// In [0, 180]. Normals are turned so that both facets are seen from the same side.
double fold_angle(const Vec3& u, const Vec3& v, bool same_direction) {
  return degrees * std::atan2(u.cross(v).norm(), same_direction ? -u.dot(v) : u.dot(v));  // 0 if one vanishes
}

constexpr double sliver_height = 1e-6;  // of the diagonal: what coordinates in a file are good for

/// The edge of a facet across which a facet lies that is `sound`, the longest of these; -1: none.
int longest_sound_edge(const TriMesh& mesh, FacetId t, const geom::Table<FacetId, char>& sound) {
  int best = -1;
  double longest = -1;
  for (int e = 0; e < 3; ++e) {
    const FacetId other = mesh.across(t, e);
    const double length = (mesh.corner(t, e) - mesh.corner(t, (e + 1) % 3)).norm();
    if (other.valid() && sound[other] && length > longest) best = e, longest = length;
  }
  return best;
}

/// Do both facets at edge e of t run through it the same way?
bool runs_alike(const TriMesh& mesh, FacetId t, int e) {
  const VertexId a = mesh.facet(t)[static_cast<std::size_t>(e)],
                 b = mesh.facet(t)[static_cast<std::size_t>((e + 1) % 3)];
  const TriMesh::Facet& f = mesh.facet(mesh.across(t, e));
  for (std::size_t k = 0; k < 3; ++k)
    if (f[k] == a && f[(k + 1) % 3] == b) return true;
  return false;
}

/// Of slivers: those of sound facets beside them.
Normals sound_normals(const TriMesh& mesh) {
  Normals normals;
  geom::Table<FacetId, char> sound;
  std::vector<FacetId> slivers;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    normals.push_back(mesh.normal(t));
    double longest = 0;
    for (int e = 0; e < 3; ++e)
      longest = std::max(longest, (mesh.corner(t, e) - mesh.corner(t, (e + 1) % 3)).norm());
    sound.push_back(normals[t].norm() > sliver_height * mesh.diagonal() * longest);
    if (!sound[t]) slivers.push_back(t);
  }
  for (std::size_t before = slivers.size() + 1; slivers.size() < before;) {
    before = slivers.size();
    std::vector<FacetId> healed;
    for (const FacetId t : slivers) {
      const int e = longest_sound_edge(mesh, t, sound);
      if (e < 0) continue;
      normals[t] = runs_alike(mesh, t, e) ? Vec3(-normals[mesh.across(t, e)]) : normals[mesh.across(t, e)];
      healed.push_back(t);
    }
    for (const FacetId t : healed) sound[t] = 1;
    std::erase_if(slivers, [&](FacetId t) { return sound[t] != 0; });
  }
  return normals;
}

std::vector<Edge> all_edges(const TriMesh& mesh) {
  struct Side {
    std::array<VertexId, 2> ends;
    FacetId facet;
    bool ascending;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t e = 0; e < 3; ++e) {
      const VertexId a = mesh.facet(t)[e], b = mesh.facet(t)[(e + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t, a < b});
    }
  std::ranges::stable_sort(sides, {}, &Side::ends);
  const Normals normals = sound_normals(mesh);
  std::vector<Edge> edges;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j].ends == sides[i].ends) ++j;
    Edge& edge = edges.emplace_back(Edge{sides[i].ends, sides[i].facet, j - i, 0});
    if (edge.sheets == 2)
      edge.fold = fold_angle(normals[sides[i].facet], normals[sides[i + 1].facet],
                             sides[i].ascending == sides[i + 1].ascending);
  }
  return edges;
}

/// Vertices joined by creases.
class JoinedByCreases {
 public:
  JoinedByCreases(const std::vector<Edge>& edges, std::size_t num_vertices) : parent_(num_vertices) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (const Edge& e : edges)
      if (e.sheets == 2) parent_[root(e)] = root(e.ends[1]);
  }
  /// The same for all edges that are joined.
  std::size_t root(const Edge& e) { return root(e.ends[0]); }

 private:
  std::size_t root(VertexId v) {
    std::size_t i = v.index();
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  std::vector<std::size_t> parent_;
};

/// Keeps the creases that are strong or joined to strong ones.
void drop_weak(std::vector<Edge>& edges, std::size_t num_vertices, double strong_angle) {
  JoinedByCreases joined(edges, num_vertices);
  std::vector<char> strong(num_vertices, 0);
  for (const Edge& e : edges) strong[joined.root(e)] |= e.sheets == 2 && e.fold > strong_angle;
  std::erase_if(edges, [&](const Edge& e) { return e.sheets == 2 && !strong[joined.root(e)]; });
}

/// Without creases that end in nothing, edge by edge.
std::vector<Edge> closed_ones(std::vector<Edge> edges, std::size_t num_vertices) {
  geom::Table<VertexId, std::size_t> degree(num_vertices, 0);
  for (const Edge& e : edges)
    for (const VertexId v : e.ends) ++degree[v];
  for (std::size_t before = edges.size() + 1; edges.size() < before;) {
    before = edges.size();
    std::erase_if(edges, [&](const Edge& e) {
      if (e.sheets != 2 || (degree[e.ends[0]] > 1 && degree[e.ends[1]] > 1)) return false;
      for (const VertexId v : e.ends) --degree[v];
      return true;
    });
  }
  return edges;
}

double length_of(const TriMesh& mesh, const Edge& e) {
  return (mesh.position(e.ends[0]) - mesh.position(e.ends[1])).norm();
}

double crease_length(const TriMesh& mesh, const std::vector<Edge>& edges) {
  double sum = 0;
  for (const Edge& e : edges)
    if (e.sheets == 2) sum += length_of(mesh, e);
  return sum;
}

constexpr double marked_fold = 360;

void set_folds(std::vector<Edge>& edges, const std::vector<std::array<VertexId, 2>>& of, double fold) {
  for (const std::array<VertexId, 2>& m : of) {
    const std::array<VertexId, 2> ends{std::min(m[0], m[1]), std::max(m[0], m[1])};
    const auto at = std::ranges::lower_bound(edges, ends, {}, &Edge::ends);
    if (at != edges.end() && at->ends == ends && at->sheets == 2) at->fold = fold;
  }
}

/// Marked edges are folded by more than any other, and strong; unmarked ones are flat.
void mark(std::vector<Edge>& edges, const FeatureOptions& options) {
  set_folds(edges, options.marked, marked_fold);
  set_folds(edges, options.unmarked, 0);
}

/// Drops pieces that fade out and are short, then all creases if too little of their length is closed.
void drop_fading(const TriMesh& mesh, std::vector<Edge>& edges, const FeatureOptions& options) {
  const double all = crease_length(mesh, edges);
  const auto is_before = [](const Edge& a, const Edge& b) { return a.ends < b.ends; };
  const std::vector<Edge> closed = closed_ones(edges, mesh.num_vertices());
  std::vector<Edge> fading;
  std::ranges::set_difference(edges, closed, std::back_inserter(fading), is_before);
  JoinedByCreases joined(fading, mesh.num_vertices());
  std::vector<double> length(mesh.num_vertices(), 0.0);
  for (const Edge& e : fading) length[joined.root(e)] += length_of(mesh, e);
  double solid = crease_length(mesh, closed);
  for (const Edge& e : fading)
    if (length[joined.root(e)] >= options.long_as_closed) solid += length_of(mesh, e);
  if (options.unmarked.empty() && solid < options.least_closed_share * all) {
    std::erase_if(edges, [](const Edge& e) { return e.sheets == 2 && e.fold < marked_fold; });
    return;
  }
  std::erase_if(fading, [&](const Edge& e) {
    return length[joined.root(e)] >= options.shortest_fading || e.fold >= marked_fold;
  });
  std::vector<Edge> kept;
  std::ranges::set_difference(edges, fading, std::back_inserter(kept), is_before);
  edges = std::move(kept);
}

/// Creases by angle, marked edges, borders and non-manifold edges; ascending by their ends.
std::vector<Edge> feature_edges(const TriMesh& mesh, const FeatureOptions& options) {
  std::vector<Edge> edges = all_edges(mesh);
  mark(edges, options);
  std::erase_if(edges, [&](const Edge& e) {
    return e.sheets == 2 && !(e.fold > std::min(options.crease_angle, options.weak_crease_angle));
  });
  drop_weak(edges, mesh.num_vertices(), options.crease_angle);
  drop_fading(mesh, edges, options);
  return edges;
}

/// Feature edges around each vertex.
class Skeleton {
 public:
  Skeleton(std::vector<Edge> edges, std::size_t num_vertices)
      : edges_(std::move(edges)), at_(num_vertices), is_corner_(num_vertices, 0), used_(edges_.size(), 0) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const VertexId v : edges_[e].ends) at_[v].push_back(e);
  }

  std::size_t degree(VertexId v) const { return at_[v].size(); }
  /// A crossing, an end, or a place where the kind changes.
  bool is_node(VertexId v) const {
    return at_[v].size() != 2 || edges_[at_[v][0]].sheets != edges_[at_[v][1]].sheets;
  }
  void make_corner(VertexId v) { is_corner_[v] = 1; }
  bool is_corner(VertexId v) const { return is_corner_[v]; }

  /// All curves between corners, then the loops.
  std::vector<FeatureCurve> curves() {
    std::fill(used_.begin(), used_.end(), 0);
    std::vector<FeatureCurve> result;
    for (VertexId v(0); v.index() < at_.size(); v = VertexId(v.value + 1))
      if (is_corner(v))
        for (const std::size_t e : at_[v])
          if (!used_[e]) result.push_back(trace(v, e));
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (!used_[e]) result.push_back(trace(edges_[e].ends[0], e));
    return result;
  }

 private:
  FeatureCurve trace(VertexId from, std::size_t e) {
    FeatureCurve curve;
    curve.sheets = edges_[e].sheets;
    curve.vertices.push_back(from);
    for (VertexId v = from;;) {
      used_[e] = 1;
      curve.facets.push_back(edges_[e].facet);
      v = edges_[e].ends[0] == v ? edges_[e].ends[1] : edges_[e].ends[0];
      if (v == from && !is_corner(v)) return curve.loop = true, curve;
      curve.vertices.push_back(v);
      if (is_corner(v)) return curve;
      e = at_[v][0] == e ? at_[v][1] : at_[v][0];
    }
  }

  std::vector<Edge> edges_;
  geom::Table<VertexId, std::vector<std::size_t>> at_;
  geom::Table<VertexId, char> is_corner_;
  std::vector<char> used_;
};

/// Turns of a curve seen at a scale.
class Turns {
 public:
  Turns(const TriMesh& mesh, const FeatureCurve& curve, double scale)
      : mesh_(mesh), curve_(curve), scale_(scale) {
    for (std::size_t i = 0; i < curve.vertices.size(); ++i) turns_.push_back(turn_at(i));
  }

  /// The vertices where the curve turns by more than `least`, more than anywhere within the scale.
  std::vector<VertexId> sharper_than(double least) const {
    std::vector<VertexId> result;
    for (std::size_t i = 0; i < turns_.size(); ++i)
      if (turns_[i] > least && is_peak(i)) result.push_back(curve_.vertices[i]);
    return result;
  }

 private:
  bool is_end(std::size_t i) const { return !curve_.loop && (i == 0 || i + 1 == curve_.vertices.size()); }
  std::size_t step(std::size_t i, int direction) const {
    const std::size_t n = curve_.vertices.size();
    return (i + n + static_cast<std::size_t>(direction + 1) - 1) % n;
  }
  const Vec3& point(std::size_t i) const { return mesh_.position(curve_.vertices[i]); }

  /// Visits vertices from i on one side, with their distance along the curve, until visit says no.
  template <class Visit>
  void walk(std::size_t i, int direction, Visit visit) const {
    double distance = 0;
    for (std::size_t j = i; !(is_end(j) && j != i);) {
      const std::size_t next = step(j, direction);
      if (next == i) return;
      distance += (point(next) - point(j)).norm();
      if (!visit(next, distance)) return;
      j = next;
    }
  }

  double turn_at(std::size_t i) const {
    if (is_end(i)) return 0;
    std::array<Vec3, 2> far;
    for (const int side : {0, 1}) {
      std::size_t before = i;
      double before_distance = 0;
      walk(i, side == 0 ? -1 : 1, [&](std::size_t j, double distance) {
        const double step_length = distance - before_distance;
        const double share = scale_ > 0 && distance > scale_ && step_length > 0
                                 ? (scale_ - before_distance) / step_length
                                 : 1.0;
        far[static_cast<std::size_t>(side)] = point(before) + share * (point(j) - point(before));
        before = j, before_distance = distance;
        return distance < scale_;
      });
    }
    const Vec3 in = point(i) - far[0], out = far[1] - point(i);
    return degrees * geom::angle_between(in, out);
  }

  bool is_peak(std::size_t i) const {
    bool peak = true;
    for (const int direction : {-1, 1})
      walk(i, direction, [&](std::size_t j, double distance) {
        if (distance > scale_) return false;
        peak &= turns_[i] > turns_[j] || (i < j && turns_[i] == turns_[j]);
        return peak;
      });
    return peak;
  }

  const TriMesh& mesh_;
  const FeatureCurve& curve_;
  double scale_;
  std::vector<double> turns_;
};

/// Vertices with little surface around them, on no curve.
std::vector<VertexId> apexes(const TriMesh& mesh, const Skeleton& skeleton, double angle) {
  geom::Table<VertexId, double> sum(mesh.num_vertices(), 0.0);
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t i = 0; i < 3; ++i)
      sum[f[i]] += degrees * geom::angle_at(mesh.position(f[i]), mesh.position(f[(i + 1) % 3]),
                                            mesh.position(f[(i + 2) % 3]));
  std::vector<VertexId> result;
  for (VertexId v(0); v.index() < sum.size(); v = VertexId(v.value + 1))
    if (sum[v] > 0 && sum[v] < angle && skeleton.degree(v) == 0) result.push_back(v);
  return result;
}

}  // namespace

double length_of(const TriMesh& mesh, const FeatureCurve& curve) {
  double sum = 0;
  for (std::size_t i = 0; i < curve.facets.size(); ++i)
    sum += (mesh.position(curve.vertices[(i + 1) % curve.vertices.size()]) - mesh.position(curve.vertices[i]))
               .norm();
  return sum;
}

FeatureOptions automatic_features() {
  FeatureOptions options;
  options.least_closed_share = 2.0 / 3;
  options.yielding = true;
  return options;
}

Features find_features(const TriMesh& mesh, const FeatureOptions& options) {
  std::vector<Edge> edges = feature_edges(mesh, options);
  const bool creased = std::ranges::any_of(edges, [](const Edge& e) { return e.sheets == 2; });
  Skeleton skeleton(std::move(edges), mesh.num_vertices());
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    if (skeleton.degree(v) > 0 && skeleton.is_node(v)) skeleton.make_corner(v);
  for (const FeatureCurve& curve : skeleton.curves())
    for (const VertexId v : Turns(mesh, curve, options.turn_scale).sharper_than(options.corner_turn))
      skeleton.make_corner(v);
  if (creased || options.least_closed_share == 0)
    for (const VertexId v : apexes(mesh, skeleton, options.apex_angle)) skeleton.make_corner(v);

  Features features;
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1))
    if (skeleton.is_corner(v)) features.corners.push_back(v);
  features.curves = skeleton.curves();
  return features;
}

}  // namespace fpo
