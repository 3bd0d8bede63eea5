#pragma once
// Angle optimization (paper, section 5): samples at triangles with a bad angle are resampled with smaller
// weights at its other two corners, so that samples come closer there.

#include <atomic>
#include <cstddef>
#include <vector>

#include "fpo/remesh/flaws.h"

namespace fpo {

/// Degrees. A triangle is bad if its smallest angle is below `smallest` or its largest above `largest`. The
/// paper wants 30 and 120; the stricter bounds can be had too, as a rule.
struct AngleOptions {
  double smallest = 33;
  double largest = 112;
  /// The c of the paper, tried in turn: the weight of a corner becomes c times what the sizing gives.
  std::vector<double> weight_shares = {0.8, 0.6, 0.4};
  double enough_delta = 0.915;          ///< with uniform sizing delta is not made smaller than this
  std::size_t max_moves = 4'000;        ///< to begin something after; and twenty a sample
  const CurveSlides* slides = nullptr;  ///< samples on curves slide along them; null: they stay
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each triangle
};

struct AngleResult {
  std::size_t bad_before = 0, bad_after = 0;  ///< triangles of the RRT
  std::size_t tried = 0, mended = 0;          ///< attempts, and those that were kept
  std::size_t reweighted = 0;                 ///< samples whose weight is still smaller at the end
};

/// The square of the degrees beyond the bounds. Keeps a reference to the domain.
FlawMeasure bad_angles(const SurfaceDomain& domain, const AngleOptions& options);

/// Takes the worst triangle first: lowers the weights of the two corners that do not have the bad angle, then
/// resamples (Algorithm 1 in the 2-ring) the corner that has it and the other two, in the end with those
/// around them. Where that does not help a corner is moved a little, at most .08 h. What makes things worse
/// (the sum over all bad triangles of the square of the degrees beyond the bounds) is undone, and if the
/// sizing is uniform what makes delta smaller and not enough. Ends when no triangle is bad or a round mends
/// nothing, or after so many moves or futile attempts in a row. At last weights are restored where that makes
/// nothing worse. The number of samples stays; fixed ones stay where they are. Deterministic. O(1) expected
/// an attempt.
AngleResult optimize_angles(SurfaceDomain& domain, const AngleOptions& options);

}  // namespace fpo
