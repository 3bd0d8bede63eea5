#pragma once
// Removal of p in the general way (redivision.h). The circles of p go, and its cell is divided among the
// others (vacancy_division.h). The new circles are the corners of their shares that p's cell did not have.

#include <span>
#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/cell_edges.h"
#include "geom/dual/state.h"
#include "geom/dual/vacancy_division.h"

namespace geom {

/// One object serves all removals of a state.
class GeneralRemoval {
 public:
  /// Keeps references.
  GeneralRemoval(DualState& state, CellClipper& clipper)
      : state_(state), clipper_(clipper), division_(state), edges_(state) {}

  /// Plans the removal of p, which changes nothing. The plan holds until the next update.
  void plan(SiteId p);
  /// Of the plan: does any other site border the cell? The circles to be, in their order (circle_before());
  /// those who win something, ascending; bounds of the power in what p has, with p, and with p or without.
  bool has_neighbours() const { return has_neighbours_; }
  std::span<const EmptyCircle> circles() const { return found_; }
  std::span<const SiteId> heirs() const { return heirs_; }
  double reach() const { return reach_; }
  double power() const { return power_; }
  /// Carries it out: the tree and the oracle follow.
  void commit(DualChange& change);

 private:
  void find_circles();

  DualState& state_;
  CellClipper& clipper_;
  VacancyDivision division_;
  CellEdges edges_;
  SiteId p_;
  bool has_neighbours_ = false;
  double reach_ = 0, power_ = 0;
  CellPieces cell_;
  std::vector<CircleId> star_;  ///< the circles of p
  std::vector<EmptyCircle> found_;
  std::vector<SiteId> heirs_;
};

}  // namespace geom
