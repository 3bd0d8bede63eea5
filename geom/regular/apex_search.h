#pragma once
// Gift wrapping: which candidate makes a regular tetrahedron with a given facet.

#include <optional>

#include "geom/exact/pencil.h"
#include "geom/exact/predicates.h"

namespace geom {

/// Let abc be a facet of the regular triangulation of some candidates (perturbed weights: predicates.h). The
/// orthospheres through abc form a pencil, and their parts on the positive side of abc grow with it. So the
/// candidates strictly on the positive side are totally ordered, e before d iff e lies inside the orthosphere
/// of abcd, and the first of them, whose orthosphere excludes all others, is the fourth corner.
///
/// Comparisons are made in doubles, in twofold precision where these cannot tell (spheres: all sites near one
/// orthosphere), exactly where that cannot.
class ApexSearch {
 public:
  /// For precision a should not be a far point.
  ApexSearch(const RankedPoint3& a, const RankedPoint3& b, const RankedPoint3& c)
      : a_(a), b_(b), c_(c), coarse_(*a.point, *b.point, *c.point) {}

  /// Is e strictly on the positive side and before all those offered so far? No corner of the facet is
  /// offered.
  bool offer(const RankedPoint3& e) {
    const auto place = coarse_.place(*e.point);
    const int side = coarse_.side(place);
    if (side < 0) return false;
    if (best_.point == nullptr) {
      if (side == 0 && !on_positive_side(e)) return false;
    } else {
      const int power_side = coarse_.power_side(best_place_, place);
      if (power_side > 0) return false;
      if ((power_side == 0 || side == 0) && !before_best(e)) return false;
    }
    best_ = e;
    best_place_ = place;
    best_fine_place_.reset();
    return true;
  }

 private:
  bool on_positive_side(const RankedPoint3& e) const {
    return orient3(a_.point->position, b_.point->position, c_.point->position, e.point->position) > 0;
  }

  /// The same where doubles cannot tell.
  bool before_best(const RankedPoint3& e) {
    if (!fine_) fine_.emplace(*a_.point, *b_.point, *c_.point);
    if (!best_fine_place_) best_fine_place_ = fine_->place(*best_.point);
    const auto place = fine_->place(*e.point);
    const int side = fine_->side(place);
    if (side < 0) return false;
    const int power_side = fine_->power_side(*best_fine_place_, place);
    if (power_side > 0) return false;
    if (power_side < 0 && side > 0) return true;
    return conflicts3(a_, b_, c_, best_, e) && on_positive_side(e);
  }

  RankedPoint3 a_, b_, c_, best_{nullptr, 0};
  Pencil<double> coarse_;
  Pencil<double>::Place best_place_{};
  std::optional<Pencil<DoubleDouble>> fine_;  // made when first wanted
  std::optional<Pencil<DoubleDouble>::Place> best_fine_place_;
};

}  // namespace geom
