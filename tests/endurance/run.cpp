#include "tests/endurance/run.h"

#include <exception>

#include "geom/check.h"
#include "tests/endurance/minimise.h"

namespace endurance {
namespace {

/// The insertions that lead to a stage, in the order in which Stage::rebuilt() makes them.
std::vector<Operation> insertions(const Stage& stage) {
  std::vector<Operation> result;
  for (const geom::SiteId s : stage.present()) result.push_back({true, s, stage.point(s)});
  return result;
}

}  // namespace

RunResult run(const Course& course, const RunOptions& options) {
  RunResult result;
  MoveMaker maker(course, options.seed);
  geom::Rng& rng = maker.rng();
  bool search = true;
  auto stage = make_stage(course.place, search);
  std::vector<Operation> log;
  std::size_t inherited = 0;  // operations of the log that were not done by this run
  try {
    while (result.moves < options.moves && !(options.interrupted && options.interrupted())) {
      maker.move(*stage, log);
      ++result.moves;
      if (result.moves % options.check_every == 0) stage->check(), ++result.checks;
      if (result.moves % options.brute_every == 0) {
        stage->check_by_brute_force(rng);
        ++result.brute_force_checks;
      }
      if (result.moves % options.rebuild_every != 0) continue;
      auto fresh = stage->rebuilt();
      stage->compare(*fresh);
      ++result.rebuilds;
      stage = std::move(fresh);
      search = !search;
      result.operations += log.size() - inherited;
      log = insertions(*stage);
      inherited = log.size();
    }
    verify(*stage, rng);
  } catch (const std::exception& error) {  // also geom::InputError: no input was bad
    result.failure = Replay{error.what(), course.place, search, log};
  }
  result.operations += log.size() - inherited;
  return result;
}

Replay minimised(const Replay& failure, std::size_t most_calls) {
  // To verify always finds faults that later operations hide, but costs much on long sequences.
  const bool always = fault_of(failure, false).empty();
  Replay result = failure;
  const auto fails = [&](const std::vector<Operation>& operations) {
    Replay trial = failure;
    trial.operations = operations;
    return !fault_of(trial, always).empty();
  };
  if (!fails(failure.operations)) return result;
  result.operations = minimised(failure.operations, fails, most_calls);
  result.remark = fault_of(result, always);
  return result;
}

}  // namespace endurance
