#pragma once
// Angle optimization (paper, section 5) in the plane: samples at triangles with a bad angle are resampled
// with smaller weights at its other two corners, so that samples come closer there.

#include <atomic>
#include <cstddef>
#include <vector>

#include "fpo/plane_domain.h"

namespace fpo {

struct PlaneAngleOptions {
  /// Degrees: a triangle with a smaller angle is bad. The paper wants 30; this much can be had as a rule.
  double smallest = 32;
  /// The c of the paper, tried in turn: the weight of a corner becomes c times what the sizing gives. 1: the
  /// samples are only resampled.
  std::vector<double> weight_shares = {1, 0.8, 0.6, 0.4};
  int max_rounds = 30;                             ///< in each, every bad triangle is tried
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each triangle
};

struct PlaneAngleResult {
  std::size_t bad_before = 0, bad_after = 0;  ///< triangles
  std::size_t tried = 0, mended = 0;          ///< attempts at a triangle, and those that bettered it
};

/// Takes the worst triangle first: lowers the weights of the two corners that do not have the bad angle, then
/// resamples (Algorithm 1 in the 2-ring) the corner that has it and the other two; if that does not do, also
/// the samples around them. An attempt is kept if the sum over all bad triangles of the square of the missing
/// degrees has decreased and no sample is hidden; else everything is put back. Weights are restored at the
/// end where that makes nothing worse. Ends when no triangle is bad or a round betters nothing. The number of
/// samples stays. Deterministic. O(1) expected an attempt.
PlaneAngleResult optimize_angles(PlaneDomain& domain, const PlaneAngleOptions& options = {});

}  // namespace fpo
