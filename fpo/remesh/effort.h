#pragma once
// How good, how long: three words for iterations, goal and rest, and when a run has stopped gaining.

#include <algorithm>
#include <span>

#include "fpo/remesh/remesh_defaults.h"

namespace fpo {

/// draft: 5 iterations, which give all of the triangles' quality but not of delta; good: until delta is .9,
/// samples at rest (rest.h) where it is already; best: the defaults (remesh_defaults.h).
enum class Effort { draft, good, best };

/// Sets goal and choices before complete(); what is chosen already stays. Throws geom::InputError if the
/// method is another than farthest point optimization, unless it is best.
inline void use_effort(Effort effort, RemeshOptions& options, Choices& choices) {
  constexpr int draft_iterations = 5;
  constexpr double good_delta = 0.9;
  if (effort == Effort::best) return;
  geom::require(options.method == Method::fpo, "draft and good are of farthest point optimization only");
  if (effort == Effort::draft && !choices.iterations) choices.iterations = draft_iterations;
  if (effort == Effort::good) options.optimize.target_delta = good_delta;
  if (effort == Effort::good) choices.rest = true;
  if (!choices.come_closer) choices.come_closer = false;
}

/// The smallest angle that angle optimization wants, and the largest that goes with it (33 and 112 by
/// default), in degrees.
inline void set_least_angle(AngleOptions& angles, double smallest) {
  geom::require(smallest >= 1 && smallest <= 45, "the smallest angle wanted must be from 1 to 45 degrees");
  angles.smallest = smallest;
  angles.largest = 156 - 4 * smallest / 3;
}

/// Whether the last quarter of the iterations (five at least) has gained nothing that is worth its time: less
/// than .001 in the mean of delta, and no delta more than .002 above the best before.
inline bool stopped_gaining(std::span<const IterationReport> iterations) {
  constexpr double least_gain = 0.001, least_delta_gain = 0.002;
  const std::size_t last = std::max<std::size_t>(5, iterations.size() / 4);
  if (iterations.size() < 2 * last) return false;
  const auto before = iterations.first(iterations.size() - last), after = iterations.last(last);
  const auto best = [](auto part) { return std::ranges::max(part, {}, &IterationReport::delta).delta; };
  return after.back().mean_delta - before.back().mean_delta < least_gain &&
         best(after) - best(before) < least_delta_gain;
}

}  // namespace fpo
