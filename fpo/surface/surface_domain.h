#pragma once
// Farthest point optimization on a surface (paper, section 4): the samples, their restricted power diagram,
// and the heap of empty circles.
//
// A sample where the sizing wants edges of length h has weight (c h)^2 (section 3.2 with k chosen so that the
// weight is a squared length), or 0 if the sizing is uniform (or on request): equal weights do nothing. The
// weight is that of the sample's own place: it changes as the sample moves.

#include <array>
#include <memory>
#include <span>

#include "fpo/domain.h"
#include "fpo/farthest.h"
#include "fpo/followers.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/move_guard.h"
#include "geom/dual/restricted_dual.h"
#include "geom/indexed_heap.h"
#include "geom/power/restricted_power.h"

namespace fpo {

/// Where neighbours come from: the regular triangulation (the paper's way) or a spatial search. Same results.
enum class Engine { search, triangulation };

/// The factor c with which, by measurement, edge lengths follow h best: their logarithms against those of h
/// have slope 1 +- .05 (bench-adaptive). Local moves keep the density of the initial samples if c is 2/3;
/// global ones carry samples to where they find room, which a larger c must balance.
inline double best_weight_factor(Scope scope) { return scope == Scope::global ? 0.75 : 2.0 / 3; }

struct SurfaceOptions {
  double weight_factor = best_weight_factor(Scope::two_ring);  ///< c
  bool weighted = true;  ///< else the diagram is the Voronoi diagram even if the sizing is not uniform
  Engine engine = Engine::search;
  geom::CornerTypes corners = geom::CornerTypes::c_only;
  std::size_t num_fixed = 0;  ///< the samples with smaller ids stay where they are
  std::uint64_t seed = 1;  ///< of the order in which the oracle is filled (the result does not depend on it)
  int threads = 1;         ///< that build the first diagram; no matter to the result
  Priority farthest = by_radius;  ///< which empty circle is the farthest point
};

class SurfaceDomain final : public Domain {
 public:
  /// Keeps a reference to the mesh. Cost: the facets and the fragments of the diagram, times log n
  /// (more if a facet is degenerate: then samples are inserted one by one). Throws InputError if there is no
  /// sample or no facet.
  /// Keeps the guard, if there is one, who is asked in each move.
  SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing, std::span<const SurfaceSample> samples,
                const SurfaceOptions& options = {}, MoveGuard* guard = nullptr);
  /// With uniform sizing.
  SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                const SurfaceOptions& options = {});

  std::size_t num_samples() const override { return samples_.size(); }
  bool is_fixed(SiteId x) const override { return x.index() < options_.num_fixed; }
  double separation(SiteId x) override;
  void remove(SiteId x) override;
  Circle largest_empty(Scope scope) override;
  bool is_farther(const Circle& c, SiteId x) override;
  void insert_at(SiteId x, const Circle& c) override;
  void put_back(SiteId x) override;
  bool move(SiteId x, Scope scope) override { return try_move(x, scope) == MoveOutcome::moved; }
  /// The same move, and whether the guard allowed it. What it forbids is as if it had not been tried. The
  /// removal is planned only if it can be (surface_removal.h): the outcome is that of the steps, to the bit.
  MoveOutcome try_move(SiteId x, Scope scope);
  /// Distance over h to the nearest sample in space; with weights to the nearest of those that are first in
  /// power or in neighbours(x).
  double normalized_spacing(SiteId x) override;
  /// The link of x in the RRT (section 4.1); of a sample without triangles the nearest one.
  void neighbours(SiteId x, std::vector<SiteId>& out) override;
  void expect(SiteId x) override;
  void check() const override;

  /// Puts the removed sample at a place, its weight to be `weight_share` of what the sizing gives, there and
  /// wherever it goes: less in angle optimization (section 5), more to protect features.
  void insert_at(SiteId x, const SurfaceSample& place, double weight_share);
  /// What the sizing gives x: (c h)^2, also if it is uniform.
  double full_weight(SiteId x) const;
  double weight_share(SiteId x) const { return weight_share_[x]; }
  /// Samples with an empty cell.
  std::size_t num_hidden() const;

  const SurfaceSample& sample(SiteId x) const { return samples_[x]; }
  const geom::RestrictedDual& dual() const { return *dual_; }
  /// The diagram with all its fragments, as it is now. Cost: that of building it.
  std::unique_ptr<geom::RestrictedPower> diagram() const;
  /// The polygons of one cell, ascending by facet.
  std::vector<geom::FacetPolygon> cell(SiteId x) { return dual_->cell(x); }
  /// Another domain with the same samples, weights and diagram.
  SurfaceDomain rebuilt() const;
  /// The least bound of the power in the cell of x.
  double reach(SiteId x) { return dual_->reach(x); }
  const geom::TriMesh& mesh() const { return mesh_; }
  /// What the last removal or insertion changed.
  const geom::RestrictedDual::Change& last_change() const { return *last_change_; }
  /// Told each change until they are removed.
  Followers<geom::RestrictedDual::Change>& followers() { return followers_; }
  const Sizing& sizing() const { return sizing_; }

 private:
  friend class SurfaceRemoval;
  struct CircleOrder {
    const geom::RestrictedDual* dual;
    bool operator()(CircleId a, CircleId b) const { return circle_before(dual->circle(a), dual->circle(b)); }
  };
  struct Start {
    std::span<const SurfaceSample> samples;
    geom::Table<SiteId, double> weight_shares;
  };

  SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing, Start start, const SurfaceOptions& options,
                MoveGuard* guard);
  void insert(SiteId x, CircleId at = CircleId());
  double weight_at(SiteId x) const;
  geom::WeightedPoint3 point_of(SiteId x) const;
  geom::NeighbourOracle::Nearest nearest_to(SiteId x) const;
  bool equal_weights() const { return sizing_.is_uniform() || !options_.weighted; }
  double priority(const SurfaceSample& place, double radius2) const {
    if (options_.farthest == by_radius) return radius2;  // which asks for no wanted length
    return options_.farthest({place.position, radius2, sizing_.at(place)});
  }
  double priority(const geom::EmptyCircle& c) const {
    return options_.farthest == by_radius ? c.radius2 : priority({c.center, c.facet}, c.radius2);
  }
  /// The heap's order.
  bool goes_before(const geom::EmptyCircle& a, const geom::EmptyCircle& b) const;
  Circle largest_in_two_ring();
  bool is_farther(const geom::EmptyCircle& c, SiteId x, std::span<const SiteId> heirs) const;
  bool is_offered(const geom::EmptyCircle& circle) const;
  void apply(const geom::RestrictedDual::Change& change);

  const geom::TriMesh& mesh_;
  Sizing sizing_;
  SurfaceOptions options_;
  MoveGuard* guard_;
  geom::Table<SiteId, SurfaceSample> samples_;
  geom::Table<SiteId, double> weight_share_;
  bool unweighted_;                               ///< all weights are and have always been 0
  std::unique_ptr<geom::NeighbourOracle> paper_;  ///< Engine::triangulation
  std::unique_ptr<geom::RestrictedDual> dual_;
  geom::IndexedHeap<CircleId, CircleOrder> circles_;
  std::array<SiteId, 3> expected_;  ///< the samples that are next, the last one first
  const geom::RestrictedDual::Change* last_change_ = nullptr;
  Followers<geom::RestrictedDual::Change> followers_;
  SiteId near_removed_;       ///< a sample near the removed one if that had no cell
  std::vector<SiteId> link_;  // workspace
};

}  // namespace fpo
