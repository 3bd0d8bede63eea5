#pragma once
// A removal that is only planned, for a site that mostly comes back nearby: what the hole would be is known,
// nothing is changed. It ends in cancel() or in move(), and holds until the next update of its dual.

#include <optional>
#include <span>

#include "geom/dual/state.h"

namespace geom {

class DualUpdates;

class PlannedRemoval {
 public:
  /// None if p has no cell, or all of its surface alone, or with CornerTypes::all: then it must be removed in
  /// fact. Keeps a reference.
  static std::optional<PlannedRemoval> of(SiteId p, DualUpdates& updates);

  /// The sites that win something.
  std::span<const SiteId> heirs() const { return hole_.heirs; }
  /// Those that the hole would have.
  std::span<const EmptyCircle> circles() const { return hole_.circles; }
  /// Upper bounds of the power in p's cell, and of that there without p.
  double reach() const { return hole_.reach; }
  double max_radius2() const { return hole_.max_radius2; }
  /// Makes these bounds the least. Cost: the facets around p.
  void sharpen();

  /// p stays.
  const DualChange& cancel();
  /// To the center of a circle: a planned one by its place among circles(), or any other that does not touch
  /// p.
  struct Target {
    std::size_t planned = 0;
    CircleId circle;  ///< none: the planned one
  };
  /// The removal and an insertion in one. Mostly the sites around p are the same before and after, and its
  /// circles move where they are. `home`: as in RestrictedDual::insert().
  const DualChange& move(const WeightedPoint3& point, FacetId home, Target target);

 private:
  struct Hole {
    std::span<const SiteId> heirs;
    std::span<const EmptyCircle> circles;
    double reach, max_radius2;
  };
  PlannedRemoval(SiteId p, DualUpdates& updates, bool is_fast);
  void read();

  DualUpdates* updates_;
  SiteId p_;
  bool is_fast_;  ///< planned in the fast way, else in the general one
  Hole hole_{};
};

}  // namespace geom
