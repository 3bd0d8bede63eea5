#pragma once
// The place that the sample that is out came from: whether another is farther, and what is around it
// (Algorithm 1, lines 6 and 9).

#include <vector>

#include "fpo/plane/circle_queue.h"
#include "geom/regular/regular2.h"

namespace fpo {

class VacatedPlace {
 public:
  /// Keeps references.
  VacatedPlace(const geom::Regular2& triangulation, const CircleQueue& circles)
      : triangulation_(triangulation), circles_(circles) {}

  /// x is about to be removed. `uniform`: no sample has a weight.
  void note(SiteId x, bool uniform);

  // Between its removal, which made `change`, and the next insertion.

  const geom::WeightedPoint2& point() const { return left_; }
  /// Has a circle of the squared radius about the center of t a larger priority than this place?
  bool is_beaten_by(geom::SimplexId t, double radius2, const geom::Regular2::Change& change) const;
  /// The first circle in a disk of two rings: of the triangles with a corner in the link of the sample, those
  /// that fill its hole included.
  geom::SimplexId first_around(const geom::Regular2::Change& change);

 private:
  const geom::Regular2& triangulation_;
  const CircleQueue& circles_;
  geom::WeightedPoint2 left_;  ///< the sample as it was
  bool owned_itself_ = false;  ///< the place was in the sample's cell for certain; else these two are known:
  double separation_ = 0;      ///< of the sample
  SiteId near_;                ///< a visible sample close to it, if it was hidden
  std::vector<SiteId> ring_;   // workspace
};

}  // namespace fpo
