#include "tools/convergence.h"

#include <time.h>

#include <atomic>

#include "fpo/shortest_edge.h"
#include "fpo/surface/surface_domain.h"
#include "geom/check.h"

namespace tools {
namespace {

io::Series series(const std::vector<double>& values, const Way& way, double width) {
  io::Series result;
  result.colour = way.colour;
  result.width = width;
  for (std::size_t i = 0; i < values.size(); ++i)
    result.points.push_back({static_cast<double>(i), values[i]});
  return result;
}

}  // namespace

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Convergence converge(fpo::Domain& domain, const Way& way, double start, const ConvergenceOptions& options) {
  Convergence result;
  if (way.shortest_edges) {
    const double before = thread_seconds();
    fpo::remove_shortest_edges(domain);
    result.removal_seconds = thread_seconds() - before;
  }
  std::atomic<bool> enough = false;
  fpo::OptimizeOptions o;
  o.max_iterations = options.iterations;
  o.target_delta = 2;
  o.scope = way.scope;
  o.order = options.order;
  o.interrupted = &enough;
  const auto n = static_cast<double>(domain.num_samples());
  o.on_iteration = [&](const fpo::IterationReport& r) {
    const double before = thread_seconds();
    result.delta.push_back(r.delta);
    result.mean_delta.push_back(r.mean_delta);
    result.microseconds.push_back(1e6 * (before - start) / n);
    if (options.measure) result.measured.push_back(options.measure());
    enough = r.mean_delta >= options.enough_mean_delta;
    start += thread_seconds() - before;
  };
  fpo::optimize(domain, o);
  return result;
}

Convergence converge(const geom::TriMesh& surface, std::size_t samples, std::uint64_t seed, const Way& way,
                     const ConvergenceOptions& options) {
  const auto initial = fpo::random_samples(surface, samples, seed);
  const double start = thread_seconds();
  fpo::SurfaceDomain domain(surface, initial);
  return converge(domain, way, start, options);
}

Convergence mean(std::span<const Convergence> runs) {
  geom::require(!runs.empty(), "no run to take the mean of");
  Convergence result = runs[0];
  const auto add = [](std::vector<double>& sum, const std::vector<double>& terms) {
    geom::require(sum.size() == terms.size(), "the runs have different numbers of iterations");
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += terms[i];
  };
  for (const Convergence& run : runs.subspan(1)) {
    add(result.delta, run.delta);
    add(result.mean_delta, run.mean_delta);
    add(result.microseconds, run.microseconds);
    result.removal_seconds += run.removal_seconds;
  }
  const auto count = static_cast<double>(runs.size());
  for (std::vector<double>* values : {&result.delta, &result.mean_delta, &result.microseconds})
    for (double& value : *values) value /= count;
  result.removal_seconds /= count;
  return result;
}

io::Chart convergence_chart(std::span<const Way> names, std::span<const Convergence> runs) {
  io::Chart chart{"", {"iteration"}, {"delta (thick), mean delta (thin)", 0.5, 0.95}, {}, {}};
  for (std::size_t w = 0; w < runs.size(); ++w) {
    chart.series.push_back(series(runs[w].delta, names[w], 2));
    chart.series.back().name = runs.size() > 1 ? names[w].name : "";
    chart.series.push_back(series(runs[w].mean_delta, names[w], 0.9));
  }
  return chart;
}

io::Chart runtime_chart(std::span<const Way> names, std::span<const Convergence> runs) {
  io::Chart chart{"", {"iteration"}, {"microseconds a sample"}, {}, {}};
  for (std::size_t w = 0; w < runs.size(); ++w) {
    chart.series.push_back(series(runs[w].microseconds, names[w], 1.6));
    chart.series.back().name = names[w].name;
  }
  return chart;
}

}  // namespace tools
