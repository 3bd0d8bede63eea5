#include "fpo/optimize.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "fpo/interruption.h"
#include "fpo/stopwatch.h"
#include "geom/check.h"
#include "geom/rng.h"

namespace fpo {
namespace {

constexpr std::size_t iterations_to_gain = 5;

/// `means`: mean delta before the first iteration and after each.
bool has_gained(std::span<const double> means, double least) {
  if (means.size() <= iterations_to_gain) return true;
  return means.back() - means.last(iterations_to_gain + 1).front() >= least;
}

std::vector<SiteId> movable_samples(const Domain& domain) {
  std::vector<SiteId> samples;
  samples.reserve(domain.num_samples());
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    if (!domain.is_fixed(SiteId(i))) samples.emplace_back(i);
  return samples;
}

}  // namespace

IterationReport measure(Domain& domain) {
  IterationReport report;
  report.delta = std::numeric_limits<double>::infinity();
  double sum = 0;
  std::vector<SiteId> samples = movable_samples(domain);
  if (samples.empty())
    for (std::size_t i = 0; i < domain.num_samples(); ++i) samples.emplace_back(i);
  for (const SiteId x : samples) {
    const double spacing = domain.normalized_spacing(x);
    report.delta = std::min(report.delta, spacing);
    sum += spacing;
  }
  report.mean_delta = sum / static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  return report;
}

OptimizeResult optimize(Domain& domain, const OptimizeOptions& options) {
  const Stopwatch watch;
  geom::Rng rng(options.seed);
  std::vector<SiteId> samples = movable_samples(domain);
  OptimizeResult result;
  std::vector<double> means;

  const auto report = [&](int iteration, std::size_t moved) {
    result.last = measure(domain);
    result.last.iteration = iteration;
    result.last.moved = moved;
    result.last.seconds = watch.seconds();
    means.push_back(result.last.mean_delta);
    if (options.on_iteration) options.on_iteration(result.last);
  };

  if (options.order == VisitOrder::shuffled_once) rng.shuffle(std::span(samples));
  report(0, 0);
  for (int iteration = 1; iteration <= options.max_iterations; ++iteration) {
    std::size_t moved = 0;
    if (options.order == VisitOrder::shuffled) rng.shuffle(std::span(samples));
    const std::vector<SiteId> order = restless(domain, samples, options.rest_spacing);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const SiteId x = order[i];
      if (i + look_ahead < order.size()) domain.expect(order[i + look_ahead]);
      if (interrupted(options.interrupted)) {
        report(iteration, moved);
        result.reason = StopReason::interrupted;
        return result;
      }
      if (options.on_move) options.on_move(result.moves);
      try {
        moved += domain.move(x, options.scope);
      } catch (const geom::Bug& bug) {
        throw geom::Bug("move " + std::to_string(result.moves) + ": " + bug.what());
      }
      ++result.moves;
    }
    report(iteration, moved);
    if (moved == 0) return result.reason = StopReason::nothing_moved, result;
    if (result.last.delta > options.target_delta) return result.reason = StopReason::target_reached, result;
    if (options.least_gain && !has_gained(means, *options.least_gain))
      return result.reason = StopReason::nothing_gained, result;
  }
  result.reason = StopReason::iteration_cap;
  return result;
}

}  // namespace fpo
