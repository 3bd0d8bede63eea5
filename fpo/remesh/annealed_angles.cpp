#include "fpo/remesh/annealed_angles.h"

#include <algorithm>
#include <cmath>

namespace fpo {

using geom::FacetId;
using geom::VertexId;

namespace {

namespace annealing {
constexpr int num_moves = 4000;
constexpr double hottest = 10, coldest = 0.03;  // T, in squared degrees
constexpr double margin = 0.5;         // degrees: what is good by less counts, lest it ends just below
constexpr double least_cosine = -0.5;  // between neighbours, or as it was: small turns can add up to a fold
constexpr double rounding = 1e-9;
}  // namespace annealing

class Annealing {
 public:
  Annealing(AngleEdits& edits, FacetId t, geom::Rng& rng) : edits_(edits), rng_(rng) {
    const EditedMesh& mesh = edits.mesh();
    const EditedMesh::Facet& corners = mesh.facet(t);
    const auto grown = [&](const std::vector<VertexId>& vertices) {
      return vertices_of(mesh, region_of(mesh, vertices));
    };
    vertices_ = grown(grown({corners.begin(), corners.end()}));
    region_ = region_of(mesh, grown(vertices_));
    before_ = edits.score(region_);
    cosine_before_ = edits.least_cosine(region_);
    now_ = least_ = before_.penalty;
  }

  bool run() {
    for (int i = 0; i < annealing::num_moves; ++i) {
      if (!move(temperature(i)) || !is_least()) continue;
      best_ = moves_.size();
      if (edits_.score(region_).bad == 0) break;
    }
    undo_to(best_);
    if (best_ > 0 && is_better(edits_.score(region_))) return true;
    undo_to(0);
    return false;
  }

 private:
  static double temperature(int i) {
    return annealing::hottest *
           std::pow(annealing::coldest / annealing::hottest, i / double{annealing::num_moves});
  }

  /// One that is kept.
  struct Move {
    VertexId v;
    SurfaceSample from;
    std::size_t edits_before;
  };

  bool move(double temperature) {
    const VertexId v = vertices_[rng_.below(vertices_.size())];
    const std::optional<SurfaceSample> to = edits_.random_place(v, rng_);
    if (!to) return false;
    const FacetRegion around = edits_.region_at(v);
    if (!std::ranges::includes(region_, around)) return false;
    const double was = edits_.score(around).penalty;
    const std::size_t edits = edits_.num_edits();
    if (!edits_.move(v, *to, around)) return false;
    const double rise = edits_.score(around).penalty - was;
    if (rise > 0 && rng_.uniform() >= std::exp(-rise / temperature)) return edits_.undo_to(edits), false;
    moves_.push_back({v, edits_.sample(v), edits});
    edits_.set_sample(v, *to);
    now_ += rise;
    return true;
  }

  bool is_better(const AngleScore& after) const {
    if (edits_.least_cosine(region_) < std::min(annealing::least_cosine, cosine_before_)) return false;
    const bool is_less_bad =
        after.bad < before_.bad && after.least >= std::min(edits_.rules.good, before_.least);
    return is_less_bad || edits_.is_better(after, before_);
  }

  bool is_least() {
    if (!(now_ < least_ - annealing::rounding)) return false;
    least_ = now_;
    return true;
  }

  /// All but the first moves.
  void undo_to(std::size_t number) {
    for (; moves_.size() > number; moves_.pop_back()) {
      edits_.undo_to(moves_.back().edits_before);
      edits_.set_sample(moves_.back().v, moves_.back().from);
    }
  }

  AngleEdits& edits_;
  geom::Rng& rng_;
  std::vector<VertexId> vertices_;
  FacetRegion region_;
  AngleScore before_;
  double cosine_before_;
  double now_, least_;  ///< penalties
  std::vector<Move> moves_;
  std::size_t best_ = 0;  ///< after so many of them
};

}  // namespace

bool anneal_angles(AngleEdits& edits, FacetId t, geom::Rng& rng) {
  const AngleRules rules = edits.rules;
  edits.rules.smallest = rules.good + annealing::margin;
  const bool is_better = Annealing(edits, t, rng).run();
  edits.rules = rules;
  return is_better;
}

}  // namespace fpo
