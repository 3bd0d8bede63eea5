#include "fpo/remesh/last_angles.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "fpo/interruption.h"
#include "fpo/remesh/angle_edits.h"
#include "fpo/remesh/annealed_angles.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

namespace mending {
constexpr int most_rounds = 10;
constexpr std::size_t least_attempts = 200, share_of_attempts = 4, most_attempts = 1000;
constexpr int most_at_once = 8;  // changes for a triangle, before others have their turn
constexpr std::size_t few = 16;  // bad triangles that are not stuck: more are not annealed,
constexpr std::size_t times_annealed = 8, share_of_times = 20, most_times = 80;  // each at most, and in all
}  // namespace mending

/// A flip of the edge from v to w, or a move of v.
struct MeshChange {
  VertexId v, w;
  SurfaceSample to;
  double penalty;
};

std::size_t attempts(const LastAnglesTask& task, std::size_t n) {
  if (task.goal.most_attempts > 0) return task.goal.most_attempts;
  return std::min(mending::least_attempts + n / mending::share_of_attempts, mending::most_attempts);
}

std::size_t times_to_anneal(std::size_t n) {
  return std::min(mending::times_annealed + n / mending::share_of_times, mending::most_times);
}

class AngleMender {
 public:
  AngleMender(const LastAnglesTask& task, const TriMesh& remesh, std::vector<SurfaceSample>& samples)
      : task_(task),
        samples_(samples),
        edits_(task, remesh, samples),
        times_left_(times_to_anneal(samples.size())),
        attempts_left_(attempts(task, samples.size())),
        is_hopeless_(remesh.num_facets(), 0),
        rng_(samples.size()),
        num_bad_(edits_.bad().size()) {}

  /// First what is wanted, then what is asked for alone, then at the cost of short edges, and at random.
  void run() {
    mend();
    AngleRules& rules = edits_.rules;
    rules = {rules.good, rules.good, 180 - 2 * rules.good, rules.least_edge, true};
    mend();
    if (!(task_.goal.crowded_edge < rules.least_edge)) return;
    rules.least_edge = task_.goal.crowded_edge;
    mend();
    is_annealed_ = true;
    if (are_few()) mend();
    if (are_few()) mend_with_more();
  }

  std::size_t num_bad() const { return num_bad_; }
  std::size_t num_mended() const { return num_mended_; }
  TriMesh mesh() const { return edits_.mesh().mesh(); }

 private:
  bool stopped() const { return attempts_left_ == 0 || interrupted(task_.angles.interrupted); }
  bool is_bad(FacetId t) const { return least_angle(edits_.mesh(), t) < edits_.rules.good; }

  /// Of those that may be annealed.
  bool are_few() {
    const auto is_stuck = [&](FacetId t) { return edits_.is_stuck_between_curves(t); };
    const std::vector<FacetId> bad = edits_.bad();
    return bad.size() - static_cast<std::size_t>(std::ranges::count_if(bad, is_stuck)) <= mending::few;
  }

  void mend() {
    is_hopeless_.assign(is_hopeless_.size(), 0);
    for (int i = 0; i < mending::most_rounds && num_bad_ > 0 && !stopped(); ++i) {
      const std::size_t mended = round();
      num_mended_ += mended;
      num_bad_ = edits_.bad().size();
      if (mended == 0) break;
    }
  }

  /// On the way more may become bad; if they do so in the end all is as before.
  void mend_with_more() {
    const auto before = std::tuple(samples_, edits_.num_edits(), num_bad_, num_mended_);
    edits_.rules.counts = false;
    mend();
    if (num_bad_ <= std::get<2>(before)) return;
    edits_.undo_to(std::get<1>(before));
    std::tie(samples_, std::ignore, num_bad_, num_mended_) = before;
  }

  /// Through all that are bad. How many changes were kept.
  std::size_t round() {
    std::size_t mended = 0;
    for (const FacetId t : edits_.bad())
      for (int k = 0; k < mending::most_at_once && !is_hopeless_[t] && is_bad(t); ++k) {
        if (stopped()) return mended;
        --attempts_left_;
        is_hopeless_[t] = !mend(t) && !(is_annealed_ && !edits_.is_stuck_between_curves(t) && anneal(t));
        mended += !is_hopeless_[t];
      }
    return mended;
  }

  bool mend(FacetId t) {
    const EditedMesh& mesh = edits_.mesh();
    const EditedMesh::Facet corners = mesh.facet(t);
    std::optional<MeshChange> best;
    for (std::size_t i = 0; i < 3; ++i) try_flip(corners[i], corners[(i + 1) % 3], best);
    for (const VertexId v : corners) try_places(v, best);
    if (!best)
      for (const VertexId v : vertices_of(mesh, region_of(mesh, {corners.begin(), corners.end()})))
        if (std::ranges::find(corners, v) == corners.end()) try_places(v, best);
    if (!best) return false;
    const FacetRegion around = edits_.region_at(best->v);
    if (best->w.valid())
      edits_.flip(best->v, best->w);
    else
      edits_.move(best->v, best->to, around), edits_.set_sample(best->v, best->to);
    hope_around(around);
    return true;
  }

  bool anneal(FacetId t) {
    const EditedMesh& mesh = edits_.mesh();
    const EditedMesh::Facet corners = mesh.facet(t);
    for (std::size_t i = 0; i < mending::times_annealed && times_left_ > 0; ++i, --times_left_)
      if (anneal_angles(edits_, t, rng_)) {
        FacetRegion around = region_of(mesh, {corners.begin(), corners.end()});
        for (int ring = 0; ring < 3; ++ring) around = region_of(mesh, vertices_of(mesh, around));
        hope_around(around);
        return true;
      }
    return false;
  }

  void hope_around(const FacetRegion& region) {
    for (const FacetId near : region_of(edits_.mesh(), vertices_of(edits_.mesh(), region)))
      is_hopeless_[near] = 0;
  }

  void try_flip(VertexId a, VertexId b, std::optional<MeshChange>& best) {
    const FacetId t = edits_.mesh().beside(a, b), u = edits_.mesh().beside(b, a);
    if (!t.valid() || !u.valid()) return;
    const FacetRegion region{std::min(t, u), std::max(t, u)};
    const AngleScore before = edits_.score(region);
    const std::size_t edits = edits_.num_edits();
    if (!edits_.flip(a, b)) return;
    keep_if_better({a, b, {}, 0}, before, edits_.score(region), best);
    edits_.undo_to(edits);
  }

  void try_places(VertexId v, std::optional<MeshChange>& best) {
    const std::vector<SurfaceSample> places = edits_.places(v);
    if (places.empty()) return;
    const FacetRegion region = edits_.region_at(v);
    const AngleScore before = edits_.score(region);
    for (const SurfaceSample& place : places) {
      const std::size_t edits = edits_.num_edits();
      if (!edits_.move(v, place, region)) continue;
      keep_if_better({v, {}, place, 0}, before, edits_.score(region), best);
      edits_.undo_to(edits);
    }
  }

  void keep_if_better(MeshChange change, const AngleScore& before, const AngleScore& after,
                      std::optional<MeshChange>& best) {
    if (!edits_.is_better(after, before)) return;
    change.penalty = after.penalty - before.penalty;
    if (!best || change.penalty < best->penalty) best = change;
  }

  const LastAnglesTask& task_;
  std::vector<SurfaceSample>& samples_;
  AngleEdits edits_;
  bool is_annealed_ = false;
  std::size_t times_left_;  ///< to anneal
  std::size_t attempts_left_;
  geom::Table<FacetId, char> is_hopeless_;  ///< nothing helped, and nothing has changed around since
  geom::Rng rng_;
  std::size_t num_bad_, num_mended_ = 0;
};

}  // namespace

LastAngles mend_last_angles(const LastAnglesTask& task, TriMesh& remesh,
                            std::vector<SurfaceSample>& samples) {
  AngleMender mender(task, remesh, samples);
  const std::size_t before = mender.num_bad();
  mender.run();
  if (mender.num_mended() > 0) remesh = mender.mesh();
  return {before, mender.num_bad(), mender.num_mended()};
}

}  // namespace fpo
