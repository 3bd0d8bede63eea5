#pragma once
// Angle optimization (paper, section 5) in the plane: samples at triangles with a bad angle are resampled
// with smaller weights at its other two corners, so that samples come closer there.

#include <atomic>
#include <cstddef>
#include <vector>

#include "fpo/plane/plane_domain.h"

namespace fpo {

struct PlaneAngleOptions {
  /// Degrees: a triangle with a smaller angle is bad. The paper wants 30; this much can be had as a rule.
  double smallest = 32;
  /// The c of the paper, tried in turn: the weight of a corner becomes c times what the sizing gives. 1: the
  /// samples are only resampled.
  std::vector<double> weight_shares = {1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4};
  /// No sample comes nearer to another, in units of the wanted edge length; the next one is for triangles
  /// that the one before leaves no way to better. If the sizing is uniform: not nearer than any was.
  std::vector<double> least_spacings = {0.82, 0.76, 0.7};
  int max_rounds = 100;  ///< for each of these; in a round every bad triangle is tried
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each triangle
};

struct PlaneAngleResult {
  std::size_t bad_before = 0, bad_after = 0;  ///< triangles
  std::size_t tried = 0, mended = 0;          ///< attempts at a triangle, and those that bettered it
};

/// Takes the worst triangle first: lowers the weights of the two corners that do not have the bad angle, then
/// resamples (Algorithm 1 in the 2-ring) the corner that has it and the other two, a few times in turn. Of
/// all weight shares and numbers of moves the best is kept, judged by the sum over all bad triangles of the
/// square of the missing degrees; no sample may be hidden or come too near to another. If none makes it
/// smaller, the samples around are resampled too. Weights are restored at the end where that makes nothing
/// worse. Ends when no triangle is bad or a round betters nothing. The number of samples stays.
/// Deterministic. O(1) expected an attempt, some hundred moves.
PlaneAngleResult optimize_angles(PlaneDomain& domain, const PlaneAngleOptions& options = {});

}  // namespace fpo
