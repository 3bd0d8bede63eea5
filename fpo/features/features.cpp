#include "fpo/features/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

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
  double fold;                   ///< between the normals of two facets, in degrees
};

/// In [0, 180]. Normals are turned so that both facets are seen from the same side.
double fold_angle(const TriMesh& mesh, FacetId a, FacetId b, bool same_direction) {
  const Vec3 u = mesh.normal(a), v = same_direction ? Vec3(-mesh.normal(b)) : mesh.normal(b);
  return degrees * std::atan2(u.cross(v).norm(), u.dot(v));  // 0 if one vanishes
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
  std::vector<Edge> edges;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j].ends == sides[i].ends) ++j;
    Edge& edge = edges.emplace_back(Edge{sides[i].ends, sides[i].facet, j - i, 0});
    if (edge.sheets == 2)
      edge.fold =
          fold_angle(mesh, sides[i].facet, sides[i + 1].facet, sides[i].ascending == sides[i + 1].ascending);
  }
  return edges;
}

/// Keeps the creases that are strong or joined to strong ones.
void drop_weak(std::vector<Edge>& edges, std::size_t num_vertices, double strong_angle) {
  std::vector<std::size_t> parent(num_vertices);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](VertexId v) {
    std::size_t i = v.index();
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Edge& e : edges)
    if (e.sheets == 2) parent[root(e.ends[0])] = root(e.ends[1]);
  std::vector<char> strong(num_vertices, 0);
  for (const Edge& e : edges) strong[root(e.ends[0])] |= e.sheets == 2 && e.fold > strong_angle;
  std::erase_if(edges, [&](const Edge& e) { return e.sheets == 2 && !strong[root(e.ends[0])]; });
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

double crease_length(const TriMesh& mesh, const std::vector<Edge>& edges) {
  double sum = 0;
  for (const Edge& e : edges)
    if (e.sheets == 2) sum += (mesh.position(e.ends[0]) - mesh.position(e.ends[1])).norm();
  return sum;
}

/// Creases by angle, borders and non-manifold edges.
std::vector<Edge> feature_edges(const TriMesh& mesh, const FeatureOptions& options) {
  std::vector<Edge> edges = all_edges(mesh);
  std::erase_if(edges, [&](const Edge& e) {
    return e.sheets == 2 && !(e.fold > std::min(options.crease_angle, options.weak_crease_angle));
  });
  drop_weak(edges, mesh.num_vertices(), options.crease_angle);
  const double closed = crease_length(mesh, closed_ones(edges, mesh.num_vertices()));
  if (closed < options.least_closed_share * crease_length(mesh, edges))
    std::erase_if(edges, [](const Edge& e) { return e.sheets == 2; });
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
    return degrees * std::atan2(in.cross(out).norm(), in.dot(out));
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
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 u = mesh.position(f[(i + 1) % 3]) - mesh.position(f[i]),
                 v = mesh.position(f[(i + 2) % 3]) - mesh.position(f[i]);
      sum[f[i]] += degrees * std::atan2(u.cross(v).norm(), u.dot(v));
    }
  std::vector<VertexId> result;
  for (VertexId v(0); v.index() < sum.size(); v = VertexId(v.value + 1))
    if (sum[v] > 0 && sum[v] < angle && skeleton.degree(v) == 0) result.push_back(v);
  return result;
}

}  // namespace

FeatureOptions automatic_features() {
  FeatureOptions options;
  options.least_closed_share = 2.0 / 3;
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
