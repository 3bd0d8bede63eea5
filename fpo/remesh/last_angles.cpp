#include "fpo/remesh/last_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fpo/interruption.h"
#include "fpo/remesh/edited_mesh.h"
#include "fpo/remesh/facet_region.h"
#include "fpo/remesh/recovered_edges.h"
#include "fpo/remesh/trial_places.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

namespace mending {
constexpr int rounds = 10;
constexpr double rounding = 1e-9;
constexpr std::size_t least_attempts = 200, share_of_attempts = 4, most_attempts = 1000;
constexpr int most_at_once = 8;             // changes for a triangle, before others have their turn
constexpr double least_gain = 1e-3;         // of the penalty around
constexpr double flat = 0.8, turned = 0.7;  // cosines between normals: of a flip, of a facet before and after
constexpr int flip_sweeps = 3;
}  // namespace mending

/// Of the facets around a place.
struct AngleScore {
  double penalty = 0, least = 180;
  std::size_t bad = 0;  ///< facets
};

/// A flip of the edge from v to w, or a move of v.
struct MeshChange {
  VertexId v, w;
  SurfaceSample to;
  double penalty;
};

std::size_t most_attempts(const LastAnglesTask& task, std::size_t n) {
  if (task.goal.most_attempts > 0) return task.goal.most_attempts;
  return std::min(mending::least_attempts + n / mending::share_of_attempts, mending::most_attempts);
}

class AngleMender {
 public:
  AngleMender(const LastAnglesTask& task, const TriMesh& remesh, std::vector<SurfaceSample>& samples)
      : task_(task),
        samples_(samples),
        mesh_(remesh),
        places_(task),
        chains_(chain_edges(task.features)),
        good_(std::min(task.goal.smallest, task.angles.smallest) - mending::rounding),
        wanted_{task.angles.smallest, task.angles.largest},
        attempts_left_(most_attempts(task, samples.size())),
        is_hopeless_(remesh.num_facets(), 0) {}

  std::vector<FacetId> bad() const {
    std::vector<std::pair<double, FacetId>> found;
    for (FacetId t(0); t.index() < mesh_.num_facets(); t = FacetId(t.value + 1))
      if (const double least = least_angle(mesh_, t); least < good_) found.emplace_back(least, t);
    std::ranges::sort(found);
    std::vector<FacetId> result;
    result.reserve(found.size());
    for (const auto& [least, t] : found) result.push_back(t);
    return result;
  }

  /// Through all that are bad. How many changes were kept.
  std::size_t round() {
    std::size_t mended = 0;
    for (const FacetId t : bad())
      for (int k = 0; k < mending::most_at_once && !is_hopeless_[t] && least_angle(mesh_, t) < good_; ++k) {
        if (stopped()) return mended;
        --attempts_left_;
        is_hopeless_[t] = !mend(t);
        mended += !is_hopeless_[t];
      }
    return mended;
  }
  /// From now on angles count as far as they are beyond the goal only: others around may lose, but not so
  /// much that more facets are bad.
  void be_modest() {
    is_modest_ = true;
    wanted_ = {good_, 180 - 2 * good_};
    is_hopeless_.assign(is_hopeless_.size(), 0);
  }
  bool stopped() const { return attempts_left_ == 0 || interrupted(task_.angles.interrupted); }
  TriMesh mesh() const { return mesh_.mesh(); }

 private:
  AngleScore score(const FacetRegion& region) const {
    AngleScore sum;
    for (const FacetId t : region) {
      const auto [least, most] = std::ranges::minmax(angles_of(mesh_, t));
      const double beyond = std::max(wanted_.smallest - least, 0.0) + std::max(most - wanted_.largest, 0.0);
      sum.penalty += beyond * beyond;
      sum.least = std::min(sum.least, least);
      sum.bad += least < good_;
    }
    return sum;
  }
  bool is_better(const AngleScore& a, const AngleScore& b) const {
    return a.penalty < (1 - mending::least_gain) * b.penalty && a.least >= std::min(good_, b.least) &&
           (!is_modest_ || a.bad <= b.bad);
  }

  bool mend(FacetId t) {
    const EditedMesh::Facet corners = mesh_.facet(t);
    std::optional<MeshChange> best;
    for (std::size_t i = 0; i < 3; ++i) try_flip(corners[i], corners[(i + 1) % 3], best);
    for (const VertexId v : corners) try_places(v, best);
    if (!best)
      for (const VertexId v : vertices_of(mesh_, region_of(mesh_, {corners.begin(), corners.end()})))
        if (std::ranges::find(corners, v) == corners.end()) try_places(v, best);
    if (!best) return false;
    const FacetRegion around = region_of(mesh_, vertices_of(mesh_, region_of(mesh_, {best->v})));
    if (best->w.valid())
      mesh_.flip(best->v, best->w);
    else
      move(best->v, best->to, around), samples_[best->v.index()] = best->to;
    for (const FacetId near : region_of(mesh_, vertices_of(mesh_, around))) is_hopeless_[near] = 0;
    return true;
  }

  bool may_flip(VertexId a, VertexId b) const {
    if (std::ranges::binary_search(chains_, std::pair<VertexId, VertexId>(std::minmax(a, b)))) return false;
    if (!mesh_.can_flip(a, b)) return false;
    return mesh_.normal(mesh_.beside(a, b)).normalized().dot(mesh_.normal(mesh_.beside(b, a)).normalized()) >
           mending::flat;
  }

  /// False, and all as before, if the quadrilateral is not convex.
  bool flip(VertexId a, VertexId b) {
    if (!may_flip(a, b)) return false;
    const FacetId t = mesh_.beside(a, b), u = mesh_.beside(b, a);
    const Vec3 before = mesh_.normal(t) + mesh_.normal(u);
    const std::size_t edits = mesh_.num_edits();
    mesh_.flip(a, b);
    for (const FacetId f : {t, u})
      if (!(mesh_.normal(f).dot(before) > mending::flat * mesh_.normal(f).norm() * before.norm())) {
        mesh_.undo_to(edits);
        return false;
      }
    return true;
  }

  void try_flip(VertexId a, VertexId b, std::optional<MeshChange>& best) {
    const FacetId t = mesh_.beside(a, b), u = mesh_.beside(b, a);
    if (!t.valid() || !u.valid()) return;
    const FacetRegion region{std::min(t, u), std::max(t, u)};
    const AngleScore before = score(region);
    const std::size_t edits = mesh_.num_edits();
    if (!flip(a, b)) return;
    keep_if_better({a, b, {}, 0}, before, score(region), best);
    mesh_.undo_to(edits);
  }

  void keep_if_better(MeshChange change, const AngleScore& before, const AngleScore& after,
                      std::optional<MeshChange>& best) {
    if (!is_better(after, before)) return;
    change.penalty = after.penalty - before.penalty;
    if (!best || change.penalty < best->penalty) best = change;
  }

  void try_places(VertexId v, std::optional<MeshChange>& best) {
    const std::vector<SurfaceSample> places = places_.around(v, samples_[v.index()], mesh_);
    if (places.empty()) return;
    const FacetRegion region = region_of(mesh_, vertices_of(mesh_, region_of(mesh_, {v})));
    const AngleScore before = score(region);
    for (const SurfaceSample& place : places) {
      const std::size_t edits = mesh_.num_edits();
      if (move(v, place, region)) keep_if_better({v, {}, place, 0}, before, score(region), best);
      mesh_.undo_to(edits);
    }
  }

  double shortest_edge(VertexId v) const {
    double least = std::numeric_limits<double>::infinity();
    for (const FacetId t : mesh_.facets_at(v))
      for (const VertexId w : mesh_.facet(t))
        if (w != v) least = std::min(least, (mesh_.position(w) - mesh_.position(v)).norm());
    return least;
  }

  /// With flips around it, in the region. False if an edge becomes too short, or a facet is turned.
  bool move(VertexId v, const SurfaceSample& to, const FacetRegion& region) {
    const double enough =
        std::min(shortest_edge(v), task_.goal.least_edge * task_.sizing.at(samples_[v.index()]));
    std::vector<Vec3> before;
    for (const FacetId t : mesh_.facets_at(v)) before.push_back(mesh_.normal(t).normalized());
    mesh_.move(v, to.position);
    if (shortest_edge(v) < enough) return false;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (!(mesh_.normal(mesh_.facets_at(v)[i]).normalized().dot(before[i]) > mending::turned)) return false;
    for (int sweep = 0; sweep < mending::flip_sweeps; ++sweep)
      if (!flip_around(v, region)) break;
    return shortest_edge(v) >= enough;
  }

  /// Edges of the facets at v, where that makes the smaller of two angles larger.
  bool flip_around(VertexId v, const FacetRegion& region) {
    bool flipped = false;
    for (const FacetId t : FacetRegion(mesh_.facets_at(v))) {
      const EditedMesh::Facet f = mesh_.facet(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = f[i], b = f[(i + 1) % 3];
        const FacetId here = mesh_.beside(a, b), there = mesh_.beside(b, a);
        if (here != t || !std::ranges::binary_search(region, there)) continue;
        const double least = std::min(least_angle(mesh_, here), least_angle(mesh_, there));
        const std::size_t edits = mesh_.num_edits();
        if (least > task_.angles.smallest || !flip(a, b)) continue;
        if (std::min(least_angle(mesh_, here), least_angle(mesh_, there)) > least) {
          flipped = true;
          break;
        }
        mesh_.undo_to(edits);
      }
    }
    return flipped;
  }

  const LastAnglesTask& task_;
  std::vector<SurfaceSample>& samples_;
  EditedMesh mesh_;
  TrialPlaces places_;
  std::vector<std::pair<VertexId, VertexId>> chains_;
  double good_;
  struct {
    double smallest, largest;
  } wanted_;  ///< angles
  bool is_modest_ = false;
  std::size_t attempts_left_;
  geom::Table<FacetId, char> is_hopeless_;  // nothing helped, and nothing has changed around since
};

}  // namespace

LastAngles mend_last_angles(const LastAnglesTask& task, TriMesh& remesh,
                            std::vector<SurfaceSample>& samples) {
  LastAngles result;
  AngleMender mender(task, remesh, samples);
  result.bad_before = result.bad_after = mender.bad().size();
  const auto mend = [&] {
    for (int round = 0; round < mending::rounds && result.bad_after > 0 && !mender.stopped(); ++round) {
      const std::size_t mended = mender.round();
      result.mended += mended;
      result.bad_after = mender.bad().size();
      if (mended == 0) break;
    }
  };
  mend();
  if (result.bad_after > 0 && !mender.stopped()) {
    mender.be_modest();
    mend();
  }
  if (result.mended > 0) remesh = mender.mesh();
  return result;
}

}  // namespace fpo
