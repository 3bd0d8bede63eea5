#pragma once
// Farthest point optimization on a surface (paper, section 4): what Algorithm 1 asks, answered by the samples
// (weighted_samples.h), their restricted power diagram (geom/dual/restricted_dual.h) and the heap of empty
// circles (circle_heap.h), which are the domain's state (surface_state.h).

#include <memory>
#include <span>
#include <vector>

#include "fpo/domain.h"
#include "fpo/expected_samples.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/move_guard.h"
#include "fpo/surface/surface_options.h"
#include "fpo/surface/surface_state.h"
#include "geom/power/restricted_power.h"

namespace fpo {

class SurfaceDomain final : public Domain {
 public:
  /// Keeps a reference to the mesh. Cost: the facets and the fragments of the diagram, times log n
  /// (more if a facet is degenerate: then samples are inserted one by one). Throws InputError if there is no
  /// sample or no facet.
  /// Keeps the guard, if there is one, who is asked in each move.
  SurfaceDomain(const geom::TriMesh& mesh, const Sizing& sizing, std::span<const SurfaceSample> samples,
                const SurfaceOptions& options = {}, MoveGuard* guard = nullptr);
  /// The same, of samples that need no copy. Of the options those of weights do not count.
  SurfaceDomain(const geom::TriMesh& mesh, WeightedSamples samples, const SurfaceOptions& options,
                MoveGuard* guard = nullptr);
  /// With uniform sizing.
  SurfaceDomain(const geom::TriMesh& mesh, std::span<const SurfaceSample> samples,
                const SurfaceOptions& options = {});

  std::size_t num_samples() const override { return state_->samples.size(); }
  bool is_fixed(SiteId x) const override { return x.index() < options_.num_fixed; }
  double separation(SiteId x) override { return state_->nearest_to(x).radius2; }
  void remove(SiteId x) override;
  Circle largest_empty(Scope scope) override;
  bool is_farther(const Circle& c, SiteId x) override;
  void insert_at(SiteId x, const Circle& c) override;
  void put_back(SiteId x) override;
  bool move(SiteId x, Scope scope) override { return try_move(x, scope) == MoveOutcome::moved; }
  /// Distance over h to the nearest sample in space; with weights to the nearest of those that are first in
  /// power or in neighbours(x).
  double normalized_spacing(SiteId x) override;
  /// The link of x in the RRT (section 4.1); of a sample without triangles the nearest one.
  void neighbours(SiteId x, std::vector<SiteId>& out) override;
  void expect(SiteId x) override;
  void check() const override;

  /// move(), and whether the guard allowed it. What it forbids is as if it had not been tried. The removal is
  /// planned only if it can be (surface_removal.h): the outcome is that of the steps, to the bit.
  MoveOutcome try_move(SiteId x, Scope scope);
  /// Puts the removed sample at a place, its weight to be `weight_share` of what the sizing gives, there and
  /// wherever it goes: less in angle optimization (section 5), more to protect features.
  void insert_at(SiteId x, const SurfaceSample& place, double weight_share);

  const WeightedSamples& samples() const { return state_->samples; }
  SurfaceSample sample(SiteId x) const { return samples()[x]; }
  double weight_share(SiteId x) const { return samples().share(x); }
  const Sizing& sizing() const { return samples().sizing(); }
  const geom::TriMesh& mesh() const { return dual().mesh(); }
  const geom::RestrictedDual& dual() const { return state_->dual; }
  /// The least bound of the power in the cell of x.
  double reach(SiteId x) { return state_->dual.reach(x); }
  /// The polygons of one cell, ascending by facet.
  std::vector<geom::FacetPolygon> cell(SiteId x) { return state_->dual.cell(x); }
  /// Few moves, if any, come soon: gives back memory for what can be found out again. No effect but on speed.
  void shrink();
  /// Samples with an empty cell.
  std::size_t num_hidden() const;
  /// What the last removal or insertion changed.
  const geom::RestrictedDual::Change& last_change() const { return *state_->last_change; }
  /// Told each change until they are removed.
  Followers<geom::RestrictedDual::Change>& followers() { return state_->followers; }
  /// The diagram with all its fragments, as it is now. Cost: that of building it.
  std::unique_ptr<geom::RestrictedPower> diagram() const;
  /// Another domain with the same samples, weights and diagram.
  SurfaceDomain rebuilt() const;

 private:
  void insert(SiteId x, const SurfaceSample& place, CircleId at = CircleId());

  SurfaceOptions options_;
  std::unique_ptr<SurfaceState> state_;  ///< where it is, wherever the domain goes
  SiteId near_removed_;                  ///< a sample near the removed one if that had no cell
  ExpectedSamples expected_;
  std::vector<SiteId> link_;  // workspace
};

}  // namespace fpo
