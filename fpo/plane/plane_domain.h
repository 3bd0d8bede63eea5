#pragma once
// The flat torus as a domain of Algorithm 1 (paper, section 3): uniform and adaptive, global and local.

#include <cstdint>
#include <span>
#include <vector>

#include "fpo/domain.h"
#include "fpo/expected_samples.h"
#include "fpo/farthest.h"
#include "fpo/followers.h"
#include "fpo/optimize.h"
#include "fpo/plane/circle_queue.h"
#include "fpo/plane/plane_weights.h"
#include "fpo/plane/vacated_place.h"
#include "geom/regular/regular2.h"

namespace fpo {

/// Fewer samples than these leave gaps of half a period, which the triangulation refuses.
inline constexpr std::size_t least_plane_samples = 32;

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
  PlaneDomain(const PlaneDomain&) = delete;

  std::size_t num_samples() const override { return input_index_.size(); }
  double separation(SiteId x) override { return triangulation_.nearest_other(x).power; }
  void remove(SiteId x) override;
  Circle largest_empty(Scope scope) override;
  bool is_farther(const Circle& c, SiteId) override;
  void insert_at(SiteId x, const Circle& c) override;
  void put_back(SiteId x) override;
  double normalized_spacing(SiteId x) override;
  void neighbours(SiteId x, std::vector<SiteId>& out) override { triangulation_.link(x, out); }
  void expect(SiteId x) override;
  void check() const override;

  /// Puts the removed sample somewhere, its weight to be `weight_share` (in (0, 1]) of what the sizing gives,
  /// there and wherever it goes (angle optimization, section 5).
  void insert_at(SiteId x, const geom::Vec2& position, double weight_share);

  const geom::Regular2& triangulation() const { return triangulation_; }
  const geom::FlatTorus& torus() const { return triangulation_.torus(); }
  bool is_uniform() const { return weights_.is_uniform(); }
  double weight_share(SiteId x) const { return weights_.share(x); }
  /// The wanted edge length at a location, and at a sample as fixed when it was inserted.
  double edge_length(const geom::Vec2& x) const { return weights_.edge_length(x); }
  double edge_length(SiteId x) const { return weights_.edge_length(x, triangulation_.point(x).weight); }
  std::size_t num_hidden() const;
  /// In the order of the input.
  std::vector<PlaneSample> samples() const;
  /// Position in the input of a sample.
  std::uint32_t input_index(SiteId x) const { return input_index_[x]; }
  /// What the last removal or insertion did.
  const geom::Regular2::Change& last_change() const { return last_change_; }
  /// Told each change until they are removed.
  Followers<geom::Regular2::Change>& followers() { return followers_; }

 private:
  PlaneDomain(const geom::FlatTorus& torus, const PlaneWeights& weights, std::span<const geom::Vec2> samples,
              const PlaneOptions& options, const std::vector<std::uint32_t>& order);
  void apply(const geom::Regular2::Change& change);

  PlaneWeights weights_;
  geom::Table<SiteId, std::uint32_t> input_index_;
  geom::Regular2 triangulation_;
  CircleQueue circles_;
  VacatedPlace vacated_;
  geom::Regular2::Change last_change_;
  Followers<geom::Regular2::Change> followers_;
  ExpectedSamples expected_;
};

}  // namespace fpo
