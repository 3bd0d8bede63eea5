#pragma once
// The general way of an update: cells are clipped from nothing, by exact clipping (cell_clipper.h), on the
// facets that they meet. It needs no assumption on the surface, the sites or the cells, and is what the fast
// way (fast_way.h) is held against.
//
// The edges of the diagram within the old cell, or around the new one, are put together facet by facet
// (cell_edges.h).

#include <span>

#include "geom/dual/cell_clipper.h"
#include "geom/dual/general_insertion.h"
#include "geom/dual/general_removal.h"
#include "geom/dual/known_cell.h"
#include "geom/dual/state.h"

namespace geom {

/// One object serves all updates of a state.
class Redivision {
 public:
  explicit Redivision(DualState& state)
      : state_(state), clipper_(state), removal_(state, clipper_), insertion_(state, clipper_) {}
  Redivision(const Redivision&) = delete;

  /// A removal that is planned, then carried out or not.
  GeneralRemoval& removal() { return removal_; }
  const GeneralRemoval& removal() const { return removal_; }
  /// Puts p in at a place.
  void insert(SiteId p, const WeightedPoint3& point, DualChange& change) {
    insertion_.insert(p, point, change);
  }
  /// All circles, there being none, and all reaches.
  void build(int threads, const KnownDiagram& known, DualChange& change);

  /// The least bound of the power in the cell of p, which is in.
  double reach(SiteId p) { return clipper_.clip(p, asked_); }
  /// The polygons of p, which is in. Valid until the next call.
  const CellPieces& cell(SiteId p) {
    clipper_.clip(p, asked_);
    return asked_;
  }

 private:
  DualState& state_;
  CellClipper clipper_;
  GeneralRemoval removal_;
  GeneralInsertion insertion_;
  CellPieces asked_;
};

}  // namespace geom
