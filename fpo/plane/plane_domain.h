#pragma once
// The flat torus as a domain of Algorithm 1 (paper, section 3): uniform and adaptive, global and local.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fpo/domain.h"
#include "fpo/farthest.h"
#include "fpo/followers.h"
#include "fpo/optimize.h"
#include "fpo/plane/circle_queue.h"
#include "fpo/plane/plane_sizing.h"
#include "geom/regular/regular2.h"

namespace fpo {

/// Fewer samples than these leave gaps of half a period, which the triangulation refuses.
inline constexpr std::size_t least_plane_samples = 32;

// Which c? A sample that leaves a hole among neighbours at p_j is put where |x - p_j|^2 - w_j is the same for
// all. Wanted are distances |x - p_j| = r (h(x) + h_j) / 2, with h growing by g: at x = 0 that is
// r^2 (h^2 + h g.p_j + ...), while w_j = c^2 (h^2 + 2 h g.p_j + ...). The linear terms agree if 2 c^2 = r^2,
// and r is about 0.95 when FPO has converged, so c near .68 keeps the grading as it is. Measured (bench-plane
// adaptive): with c = .68 the slope of log spacing against log rho is .98 .. 1.01 after 100 local iterations
// and 1.00 .. 1.04 after 400; with c = 2/3 it is .96 .. 1.00 and stays; c = .64 makes it fall to .93, c = .70
// rise to 1.05. The global variant takes samples from dense places to fill the random set's voids in sparse
// ones (its slope is .75 after one iteration with c = .66); a larger c, .75, prevents that and then slowly
// over-grades.
inline double best_plane_weight_factor(Scope scope) { return scope == Scope::global ? 0.75 : 0.68; }

struct PlaneOptions {
  double weight_factor = best_plane_weight_factor(
      Scope::two_ring);  ///< c of w = (c h)^2, the weight of a sample where edges of length h are wanted
  Priority farthest = by_radius;  ///< which empty circle is the farthest point
};

// Which start and order? Uniform: a random start and one random order for all iterations reach delta .925
// sooner than a stratified start or orders drawn anew (bench-plane start). Adaptive: the local variant needs
// the right number of samples everywhere from the start, and orders drawn anew leave fewer bad angles.
inline PlaneStart best_plane_start(bool uniform) {
  return uniform ? PlaneStart::random : PlaneStart::stratified;
}
inline VisitOrder best_visit_order(bool uniform) {
  return uniform ? VisitOrder::shuffled_once : VisitOrder::shuffled;
}

/// A sample as the user sees it.
struct PlaneSample {
  geom::Vec2 position;  ///< on the torus's grid
  double weight;        ///< 0 if uniform
};

/// Samples are numbered along a Hilbert curve through their first positions, for the sake of memory;
/// samples() gives them in the order of the input. The weight of a sample is fixed when it is inserted
/// somewhere.
class PlaneDomain final : public Domain {
 public:
  /// Keeps a reference to the sizing. edge_length_scale: s of h = s rho (PlaneDensity). Throws InputError for
  /// bad periods, fewer than least_plane_samples samples, or samples that leave a gap of half a period.
  PlaneDomain(const geom::FlatTorus& torus, const PlaneSizing& sizing, double edge_length_scale,
              std::span<const geom::Vec2> samples, const PlaneOptions& options = {});

  std::size_t num_samples() const override { return input_index_.size(); }
  double separation(SiteId x) override { return triangulation_.nearest_other(x).power; }
  bool is_farther(const Circle& c, SiteId) override;
  void remove(SiteId x) override;
  Circle largest_empty(Scope scope) override;
  void insert_at(SiteId x, const Circle& c) override;
  void put_back(SiteId x) override;
  /// Puts the removed sample somewhere, its weight to be `weight_share` (in (0, 1]) of what the sizing gives,
  /// there and wherever it goes (angle optimization, section 5).
  void insert_at(SiteId x, const geom::Vec2& position, double weight_share);
  double normalized_spacing(SiteId x) override;
  void neighbours(SiteId x, std::vector<SiteId>& out) override { triangulation_.link(x, out); }
  void expect(SiteId x) override;
  void check() const override;

  const geom::Regular2& triangulation() const { return triangulation_; }
  /// What the last removal or insertion did.
  const geom::Regular2::Change& last_change() const { return last_change_; }
  /// Told each change until they are removed.
  Followers<geom::Regular2::Change>& followers() { return followers_; }
  const geom::FlatTorus& torus() const { return triangulation_.torus(); }
  /// The wanted edge length at a location, and at a sample as fixed when it was inserted.
  double edge_length(const geom::Vec2& x) const { return scale_ * sizing_.rho(x); }
  double edge_length(SiteId x) const;
  double weight_share(SiteId x) const { return weight_share_.empty() ? 1 : weight_share_[x]; }
  bool is_uniform() const { return weight_factor_ == 0; }
  std::size_t num_hidden() const;
  /// In the order of the input.
  std::vector<PlaneSample> samples() const;
  /// Position in the input of a sample.
  std::uint32_t input_index(SiteId x) const { return input_index_[x]; }

 private:
  PlaneDomain(const geom::FlatTorus& torus, const PlaneSizing& sizing, double edge_length_scale,
              std::span<const geom::Vec2> samples, const PlaneOptions& options,
              const std::vector<std::uint32_t>& order);
  double weight_at(const geom::Vec2& x) const;
  geom::SimplexId largest_in_two_ring();
  void apply(const geom::Regular2::Change& change);

  const PlaneSizing& sizing_;
  double scale_;          ///< s of h = s rho
  double weight_factor_;  ///< c of w = (c h)^2; 0 if uniform
  geom::Table<SiteId, std::uint32_t> input_index_;
  geom::Table<SiteId, double> weight_share_;  ///< empty: all 1
  geom::Regular2 triangulation_;
  CircleQueue circles_;
  geom::Regular2::Change last_change_;
  Followers<geom::Regular2::Change> followers_;
  geom::WeightedPoint2 removed_;    ///< where the sample that is out came from
  bool owns_its_place_ = false;     ///< its place is in its cell for certain; else these two are known:
  double removed_separation_ = 0;   ///< its separation()
  geom::SiteId near_removed_;       ///< a visible sample close to it, if it was hidden
  std::vector<SiteId> ring_;        ///< scratch: around the removed sample
  std::array<SiteId, 3> expected_;  ///< the last samples announced by expect(), the latest first
};

}  // namespace fpo
