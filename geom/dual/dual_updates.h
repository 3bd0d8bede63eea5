#pragma once
// The updates of a restricted dual: each goes the fast way (fast_way.h) if that is certain, else the general
// one (redivision.h), and tells what it has changed.

#include <span>
#include <vector>

#include "geom/dual/fast_way.h"
#include "geom/dual/planned_removal.h"
#include "geom/dual/redivision.h"
#include "geom/dual/state.h"

namespace geom {

/// How often which way was taken.
struct DualWays {
  std::size_t in_place = 0, with_leeway = 0;  ///< the latter of the former
  std::size_t fast_removals = 0, fast_insertions = 0, general_removals = 0, general_insertions = 0;
};

/// One object serves all updates of a state.
class DualUpdates {
 public:
  /// Keeps references.
  DualUpdates(DualState& state, Redivision& redivision)
      : state_(state), fast_(state), redivision_(redivision) {}

  // As those of RestrictedDual.
  const DualChange& build(std::vector<WeightedPoint3> points, std::span<const FacetId> homes,
                          std::span<const SiteId> order, int threads, const KnownDiagram& known);
  const DualChange& insert(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at);
  const DualChange& remove(SiteId p);

  /// Finds out which sites of a build are regular. Updates begin with it; who only looks goes without.
  void certify_all(std::span<const KnownCell> known = {});

  /// RestrictedDual::shrink().
  void shrink() { fast_.shrink(); }
  KnownCell known_cell(SiteId p) const { return are_certified_ ? fast_.known(p) : KnownCell(); }
  const DualWays& ways() const { return ways_; }

 private:
  friend class PlannedRemoval;
  void begin();
  void insert_anyhow(SiteId p, const WeightedPoint3& point, FacetId home, CircleId at);
  void remove_generally(SiteId p);
  const DualChange& move(SiteId p, const WeightedPoint3& point, FacetId home, PlannedRemoval::Target target,
                         bool is_fast);
  void forget_shapes();
  CircleId beaten_circle(const WeightedPoint3& point) const;
  void take_net_change();

  DualState& state_;
  FastWay fast_;
  Redivision& redivision_;
  DualChange change_;
  DualWays ways_;
  bool are_certified_ = true;       ///< the sites of the build
  std::vector<CircleId> unlisted_;  ///< created and erased in the same change
};

}  // namespace geom
