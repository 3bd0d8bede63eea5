#pragma once
// Insertion of p in the general way (redivision.h). The circles that it beats go: they belong to sites of
// which it takes something. The new circles are the corners of p's cell.

#include <vector>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/cell_edges.h"
#include "geom/dual/cut_edges.h"
#include "geom/dual/state.h"

namespace geom {

/// One object serves all insertions into a state.
class GeneralInsertion {
 public:
  /// Keeps references.
  GeneralInsertion(DualState& state, CellClipper& clipper)
      : state_(state), clipper_(clipper), edges_(state), cut_(state) {}

  /// Puts p in at a place; the tree and the oracle follow.
  void insert(SiteId p, const WeightedPoint3& point, DualChange& change);

 private:
  void enter(SiteId p, const WeightedPoint3& point);
  double find_rivals(SiteId p);
  void erase_beaten(SiteId p, DualChange& change);
  bool is_beaten(const EmptyCircle& circle, SiteId p) const;
  void find_circles(SiteId p);
  void find_hidden();
  bool owns_its_place(SiteId j) const;

  DualState& state_;
  CellClipper& clipper_;
  CellEdges edges_;
  CutEdges cut_;
  CellPieces cell_, spare_;
  std::vector<EmptyCircle> found_;
  std::vector<SiteId> rivals_, around_;
  std::vector<CircleId> beaten_;
  Table<SiteId, FacetId> part_of_;  ///< where such a cell was last seen that has no circle
};

}  // namespace geom
