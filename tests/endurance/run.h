#pragma once
// One long run on one course, and what becomes of a failure.

#include <functional>
#include <optional>

#include "tests/endurance/moves.h"

namespace endurance {

struct RunOptions {
  std::uint64_t moves = 1'000'000, seed = 1;
  std::uint64_t check_every = 500, brute_every = 200, rebuild_every = 2000;
  std::function<bool()> interrupted;  ///< asked before each move; may be empty
};

struct RunResult {
  std::uint64_t moves = 0, operations = 0, checks = 0, brute_force_checks = 0, rebuilds = 0;
  std::optional<Replay> failure;  ///< not minimised: from the last rebuild on
};

/// Moves; every now and then all is verified, and the run goes on with the structure that was built from
/// nothing, of the other engine: so each failure can be had again from the sites of the last rebuild and the
/// operations after it.
RunResult run(const Course& course, const RunOptions& options);

/// The same with fewer operations, which fails, too (perhaps in another way): verified after each one if that
/// helps. At most `most_calls` trials.
Replay minimised(const Replay& failure, std::size_t most_calls);

}  // namespace endurance
