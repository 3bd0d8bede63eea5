#pragma once
// Line 5 of Algorithm 1 on a surface as an operation that ends in insert() or cancel(), lines 7 and 9.
//
// But for the first iterations nearly all samples come back into the holes that they leave. So a removal is
// only planned if it can be: the circles that the hole would have are known, but nothing is changed. Where
// the sample keeps its neighbours, its circles are then moved where they are (PlannedRemoval::move).

#include <optional>
#include <span>
#include <vector>

#include "fpo/surface/surface_domain.h"

namespace fpo {

class SurfaceRemoval {
 public:
  /// Plans the removal of x, or carries it out if there is no plan. `state`: of the domain.
  SurfaceRemoval(SurfaceDomain& domain, SurfaceState& state, SiteId x);
  SurfaceRemoval(const SurfaceRemoval&) = delete;
  SurfaceRemoval& operator=(const SurfaceRemoval&) = delete;

  SurfaceDomain& domain() const { return domain_; }
  SiteId sample() const { return x_; }
  /// Else it is carried out.
  bool is_planned() const { return plan_.has_value(); }
  /// Of a plan: the circles that the hole would have.
  std::span<const geom::EmptyCircle> planned_circles() const { return plan_->circles(); }
  /// Who wins something of the cell.
  std::span<const SiteId> heirs() const;

  /// What x leaves.
  struct Vacancy {
    std::span<const SiteId> around;  ///< the heirs; if there are none the sample that is nearest
    double reach;                    ///< an upper bound of the power in the cell of x
    double power;                    ///< and of the power there without x
  };
  /// Only if the domain has a guard. Cost of a removal that is carried out: the facets around the heirs.
  Vacancy vacancy();
  /// Replaces the bounds of a plan by the least ones, if that has not been done. Cost: the facets around x.
  bool sharpen();

  /// Line 6: looks for the circle of the largest priority. False if a plan cannot tell, for one of x's own
  /// circles is on top of the heap: then it must be carried out.
  bool find_largest(Scope scope);
  void carry_out();
  /// The circle found, valid until the next step; null if there is none.
  const geom::EmptyCircle* largest() const { return largest_; }

  /// Line 7: puts x at the center of the circle found.
  void insert();
  /// Line 9: puts x back.
  void cancel();

 private:
  void find_planned(Scope scope);

  SurfaceDomain& domain_;
  SurfaceState& state_;
  SiteId x_;
  std::optional<geom::PlannedRemoval> plan_;
  bool is_sharp_ = false;
  double reach_ = 0;            ///< of the cell, if carried out
  std::vector<SiteId> around_;  ///< Vacancy::around, if carried out
  const geom::EmptyCircle* largest_ = nullptr;
  geom::PlannedRemoval::Target target_;  ///< the circle found, to the plan
  CircleId id_;                          ///< and to the domain, if carried out
};

}  // namespace fpo
