#pragma once
// What a site loses when another one comes: does all of it hang together with circles that are beaten?
//
// Let the cell C of s be a disc with one border, on a sheet of the surface, and p another site. In a chart of
// the sheet (chart.h) let p and s be monotone, and let the axis of p, s and t meet the surface once at most
// for each neighbour t of s. Then
//
//   - where p is nearer than s, inside C, it is so in one direction up to the border of C;
//   - along an edge of C, on which a neighbour t is as near as s, p begins or ceases to be nearer once at
//     most: where it is nearer it is so up to an end of the edge, a corner of C.
//
// So each part of C that p takes has a corner of C, a circle that p beats. If these are known to be in one
// part of the cell of p, then p has no other part in C.
//
// That is asked of each site that may lose something far from p, on a sheet of its own: where samples are
// fine beside coarse ones, the cell of p is small and cells near it are large, and no sheet about p would
// cover them.

#include <span>

#include "geom/dual/chart.h"
#include "geom/dual/state.h"

namespace geom {

/// Who comes or moves. Among the neighbours of the others it counts as it was.
struct Newcomer {
  SiteId id;
  WeightedPoint3 point, old;
};

class Losses {
 public:
  /// Keeps references.
  Losses(const DualState& state, Sheets& sheets) : state_(state), sheets_(sheets) {}
  /// As said above, of s; `reached`: the circles that may be beaten. False: not certain.
  bool hang_together(SiteId s, const Newcomer& p, std::span<const CircleId> reached);

 private:
  const DualState& state_;
  Sheets& sheets_;
  Chart chart_;
};

}  // namespace geom
