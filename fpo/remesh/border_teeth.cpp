#include "fpo/remesh/border_teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

#include "geom/disjoint_sets.h"
#include "geom/mesh/angles.h"
#include "geom/mesh/opened_mesh.h"
#include "geom/mesh/surface_type.h"

namespace fpo {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double corner_turn = std::numbers::pi / 2;
constexpr std::array<double, 2> sights = {2, 4};  // in longest edges
constexpr double least_area = 8;                  // of a part, in squares of these

/// Of a mesh with one border at most at each vertex.
class Trimming {
 public:
  Trimming(const TriMesh& mesh, const Tooth& tooth)
      : mesh_(mesh),
        tooth_(tooth),
        is_left_(mesh.num_facets(), 1),
        is_small_(mesh.num_vertices(), 0),
        next_(mesh.num_vertices()),
        before_(mesh.num_vertices()),
        facet_(mesh.num_vertices()) {
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
      for (int e = 0; e < 3; ++e)
        if (!mesh.across(t, e).valid()) join(corner(t, e), corner(t, e + 1), t);
    keep_small_parts();
  }

  std::vector<FacetId> run() {
    while (cut_all()) continue;  // who was a corner may be none without another tooth
    std::vector<FacetId> left;
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
      if (is_left_[t]) left.push_back(t);
    return left;
  }

 private:
  VertexId corner(FacetId t, int i) const { return mesh_.facet(t)[static_cast<std::size_t>(i % 3)]; }
  const Vec3& at(VertexId v) const { return mesh_.position(v); }
  bool is_on_border(VertexId v) const { return next_[v].valid(); }
  int place_in(FacetId t, VertexId v) const {
    return static_cast<int>(std::ranges::find(mesh_.facet(t), v) - mesh_.facet(t).begin());
  }
  void keep_small_parts() {
    geom::DisjointSets parts(mesh_.num_vertices());
    for (const TriMesh::Facet& f : mesh_.facets())
      for (const VertexId v : {f[1], f[2]}) parts.merge(f[0].index(), v.index());
    std::vector<double> area(mesh_.num_vertices(), 0.0);
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
      area[parts.find(corner(t, 0).index())] += mesh_.area(t);
    const double least = least_area * tooth_.longest * tooth_.longest;
    for (VertexId v(0); v.index() < mesh_.num_vertices(); v = VertexId(v.value + 1))
      if (area[parts.find(v.index())] < least) is_small_[v] = 1;
  }

  /// What is left across an edge, or none.
  FacetId across(FacetId t, int e) const {
    const FacetId other = mesh_.across(t, e % 3);
    return other.valid() && is_left_[other] ? other : FacetId();
  }
  /// The border runs from a to b, along t.
  void join(VertexId a, VertexId b, FacetId t) {
    next_[a] = b;
    before_[b] = a;
    facet_[a] = t;
  }

  /// All along the borders, and what was behind those. False if there is none.
  bool cut_all() {
    bool is_any = false;
    std::deque<VertexId> waiting;
    for (VertexId v(0); v.index() < mesh_.num_vertices(); v = VertexId(v.value + 1))
      if (is_on_border(v)) waiting.push_back(v);
    while (!waiting.empty()) {
      const VertexId v = waiting.front();
      waiting.pop_front();
      if (!is_tooth(v)) continue;
      is_any = true;
      cut_off(v);
      for (const FacetId t : fan_)
        for (const VertexId x : mesh_.facet(t))
          if (x != v) waiting.push_back(x);
    }
    return is_any;
  }

  /// Is it a tip? If so, fan_ holds the facets around it, from the border on.
  bool is_tooth(VertexId v) {
    if (!is_on_border(v) || is_small_[v]) return false;
    const VertexId p = before_[v], q = next_[v];
    if (!(std::max((at(p) - at(v)).norm(), (at(q) - at(v)).norm()) < tooth_.longest)) return false;
    fan_.clear();
    double angle = 0;
    for (FacetId t = facet_[v]; t.valid(); t = across(t, place_in(t, v) + 2)) {
      const int i = place_in(t, v);
      const VertexId end = corner(t, i + 2);
      angle += geom::angle_between(at(corner(t, i + 1)) - at(v), at(end) - at(v));
      if (!(angle < tooth_.angle) || (end != p && is_on_border(end))) return false;
      fan_.push_back(t);
    }
    const bool is_by_itself = fan_.size() == 1 && !across(fan_[0], place_in(fan_[0], v) + 1).valid();
    return !is_by_itself && !is_corner(v);
  }

  void cut_off(VertexId v) {
    for (const FacetId t : fan_) is_left_[t] = 0;
    next_[v] = before_[v] = VertexId();
    for (const FacetId t : fan_) {
      const int opposite = place_in(t, v) + 1;
      join(corner(t, opposite + 1), corner(t, opposite), mesh_.across(t, opposite % 3));
    }
  }

  /// From x along the border, forward or back, at most so far: the end of that way, or of the border's half.
  Vec3 seen_from(double far, VertexId x, const Table<VertexId, VertexId>& to,
                 const Table<VertexId, VertexId>& back) const {
    double way = 0;
    VertexId behind = x;  // goes the other way, to meet halfway
    while (way < far) {
      const VertexId y = to[x];
      const double length = (at(y) - at(x)).norm();
      if (way + length > far) return at(x) + (far - way) / length * (at(y) - at(x));
      way += length;
      x = y;
      behind = back[behind];
      if (behind == x || back[behind] == x) break;
    }
    return at(x);
  }

  /// Does the border turn to the inside by much from before v to behind it, from wherever it is seen?
  bool is_corner(VertexId v) const {
    const VertexId p = before_[v], q = next_[v];
    Vec3 normal(0, 0, 0);
    for (const FacetId t : fan_) normal += mesh_.normal(t);
    const auto turn = [&](const Vec3& a, const Vec3& b) {
      const double angle = geom::angle_between(a, b);
      return normal.dot(a.cross(b)) > 0 ? angle : -angle;
    };
    return std::ranges::all_of(sights, [&](double sight) {
      const double far = sight * tooth_.longest;
      const Vec3 come = at(p) - seen_from(far, p, before_, next_), base = at(q) - at(p),
                 go = seen_from(far, q, next_, before_) - at(q);
      return turn(come, base) + turn(base, go) > corner_turn;
    });
  }

  const TriMesh& mesh_;
  Tooth tooth_;
  Table<FacetId, char> is_left_;
  Table<VertexId, char> is_small_;           ///< the part is small
  Table<VertexId, VertexId> next_, before_;  ///< along the border: with the surface on the left
  Table<VertexId, FacetId> facet_;           ///< at the border edge that begins there
  std::vector<FacetId> fan_;                 ///< of the tip that was looked at last
};

}  // namespace

std::vector<FacetId> without_teeth(const TriMesh& surface, const Tooth& tooth) {
  geom::DisjointSets sheets = geom::sheets_at_vertices(surface);
  return Trimming(geom::opened(surface, sheets).mesh, tooth).run();
}

}  // namespace fpo
