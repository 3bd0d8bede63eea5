#pragma once
// Farthest point optimization: Algorithm 1 of the paper, generalised to any domain and to weights.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "fpo/rest.h"

namespace fpo {

/// The state after an iteration, in which every sample that is not fixed and did not rest was removed and
/// inserted once.
struct IterationReport {
  int iteration = 0;      ///< 1, 2, ...; 0: the initial set
  std::size_t moved = 0;  ///< samples that went to a new position
  double delta = 0;       ///< minimum of Domain::normalized_spacing (the paper's delta_X)
  double mean_delta = 0;  ///< its mean
  double seconds = 0;     ///< since the start of optimize()
};

/// In which order an iteration visits the samples: in that of their ids ("for each x_i", Algorithm 1), in one
/// random order (the same for samples that are numbered along a curve), or in one drawn anew for each
/// iteration.
enum class VisitOrder { in_turn, shuffled_once, shuffled };

enum class StopReason { target_reached, nothing_moved, nothing_gained, iteration_cap, interrupted };

struct OptimizeOptions {
  int max_iterations = 100;
  double target_delta = 0.926;  ///< stop as soon as delta exceeds it (section 3.2)
  /// Stop as soon as five iterations have raised mean delta by less than this; none: never.
  std::optional<double> least_gain{};
  double rest_spacing = no_rest;  ///< at each iteration's start it is seen who rests (rest.h)
  Scope scope = Scope::global;
  VisitOrder order = VisitOrder::shuffled;
  std::uint64_t seed = 1;                          ///< of the random orders
  const std::atomic<bool>* interrupted = nullptr;  ///< looked at before each move
  std::function<void(const IterationReport&)>
      on_iteration;  ///< called after each iteration and once before the first
  std::function<void(std::size_t move)>
      on_move;  ///< called before each move, counted from 0 over all iterations
};

struct OptimizeResult {
  StopReason reason = StopReason::iteration_cap;
  IterationReport last;
  std::size_t moves = 0;  ///< samples removed and inserted, over all iterations
};

/// Algorithm 1. Deterministic: the result depends on the domain's content, the seed and the options alone.
/// Leaves the domain with all samples in. Throws geom::Bug with the move number in its text if the domain
/// does.
OptimizeResult optimize(Domain& domain, const OptimizeOptions& options);

inline constexpr std::size_t look_ahead = 4;  ///< moves between Domain::expect() and the move itself

/// delta and mean delta of the samples as they are (the other fields are 0), those left out that are fixed
/// unless all are. O(n) spacings.
IterationReport measure(Domain& domain);

}  // namespace fpo
