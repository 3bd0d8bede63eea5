// bench-plane: quality and speed of farthest point optimization on the flat torus.
//
//   bench-plane [quality] [adaptive] [speed] [target] [--max-n N]      default: all, N = 1048576
//
// Times are CPU seconds of one thread.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "fpo/optimize.h"
#include "fpo/plane_domain.h"
#include "fpo/plane_quality.h"
#include "fpo/shortest_edge.h"

namespace {

using namespace fpo;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// One sizing and one start on the unit torus.
struct Case {
  Case(const std::string& name, std::size_t n, std::uint64_t seed, PlaneStart start)
      : torus({1, 1}),
        sizing(named_sizing(name, torus)),
        density(*sizing, torus),
        domain(torus, *sizing, density.edge_length_scale(n), initial_plane_samples(density, n, seed, start)) {
  }
  geom::FlatTorus torus;
  std::unique_ptr<PlaneSizing> sizing;
  PlaneDensity density;
  PlaneDomain domain;
};

void quality() {
  std::printf(
      "\nuniform, stratified start, global: first iteration with delta >= .925 (wanted within 200) and with "
      "delta > .93\n");
  std::printf("%7s %5s %12s %12s %10s %10s %8s\n", "n", "seed", "delta .925", "delta .93", "delta@200",
              "mean@200", "theta");
  for (const std::size_t n : {1024, 4096}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      Case c("uniform", n, seed, PlaneStart::stratified);
      OptimizeOptions options;
      options.seed = seed;
      options.max_iterations = 200;
      options.target_delta = 1;
      int first_925 = -1, first_93 = -1;
      options.on_iteration = [&](const IterationReport& r) {
        if (first_925 < 0 && r.delta >= 0.925) first_925 = r.iteration;
        if (first_93 < 0 && r.delta >= 0.93) first_93 = r.iteration;
      };
      optimize(c.domain, options);
      const PlaneQuality q = plane_quality(c.domain);
      std::printf("%7zu %5zu %12d %12d %10.4f %10.4f %8.2f\n", n, static_cast<std::size_t>(seed), first_925,
                  first_93, q.delta, q.mean_delta, q.min_angle);
    }
  }
}

void adaptive() {
  std::printf("\nadaptive, stratified start, local, 100 iterations (field's number: max rho / min rho)\n");
  std::printf("%-8s %6s %5s %7s %8s %8s %8s %8s %6s %7s\n", "field", "n", "seed", "slope", "CV d/h", "delta",
              "mean", "theta", "<30", "hidden");
  for (const std::string name : {"waves5", "spot5", "band5", "waves11", "spot11"}) {
    for (const std::size_t n : {4096, 16384}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        Case c(name, n, seed, PlaneStart::stratified);
        OptimizeOptions options;
        options.seed = seed;
        options.scope = Scope::two_ring;
        optimize(c.domain, options);
        const PlaneQuality q = plane_quality(c.domain);
        std::printf("%-8s %6zu %5zu %7.3f %8.4f %8.4f %8.4f %8.2f %6zu %7zu\n", name.c_str(), n,
                    static_cast<std::size_t>(seed), q.grading_slope, q.spacing_variation, q.delta,
                    q.mean_delta, q.min_angle, q.angles_below_30, q.hidden);
        if (n == 16384) break;  // one seed tells enough there
      }
    }
  }
}

/// Microseconds a move, the least of a few stretches of moves after the first iteration, measuring of delta
/// included.
double microseconds_per_move(const std::string& name, std::size_t n, Scope scope) {
  Case c(name, n, 1, name == "uniform" ? PlaneStart::random : PlaneStart::stratified);
  OptimizeOptions options;
  options.scope = scope;
  options.target_delta = 1;
  options.max_iterations = 1 + static_cast<int>(std::max<std::size_t>(4, 400'000 / n));
  const int stretch = std::max(1, (options.max_iterations - 1) / 4);
  double least = 1e9, last = 0;
  options.on_iteration = [&](const IterationReport& r) {
    if (r.iteration < 1 || (r.iteration - 1) % stretch != 0) return;
    const double now = cpu_seconds();
    if (r.iteration > 1) least = std::min(least, (now - last) / static_cast<double>(stretch * n));
    last = now;
  };
  optimize(c.domain, options);
  return 1e6 * least;
}

void speed(std::size_t largest) {
  std::printf(
      "\nmicroseconds a move (remove, find, insert; CPU, one thread); a third of Schloemer's code in column "
      "2\n");
  std::printf("%8s %8s %9s %9s %9s %9s\n", "n", "wanted", "uniform", "adaptive", "local", "adapt/uni");
  const std::vector<std::pair<std::size_t, double>> sizes = {{1024, 0.9},  {4096, 1.1},   {16384, 1.4},
                                                             {65536, 3.3}, {262144, 7.7}, {1048576, 0}};
  double at_4096 = 0;
  for (const auto& [n, wanted] : sizes) {
    if (n > largest) break;
    const double uniform = microseconds_per_move("uniform", n, Scope::global);
    const double graded = microseconds_per_move("waves5", n, Scope::global);
    const double local = microseconds_per_move("waves5", n, Scope::two_ring);
    std::printf("%8zu %8.1f %9.3f %9.3f %9.3f %9.2f\n", n, wanted, uniform, graded, local, graded / uniform);
    std::fflush(stdout);
    if (n == 4096) at_4096 = uniform;
    if (n == 1048576) std::printf("growth from 4096 to 1048576: %.2f (wanted <= 4)\n", uniform / at_4096);
  }
}

void target() {
  std::printf(
      "\nCPU seconds to delta .925, uniform (peers.md: push-pull .15, .59, 2.4; FPO .13-.20, 1.1-2.3, "
      "7.8-26.6)\n");
  std::printf("%7s %5s %18s %18s\n", "n", "seed", "global", "SER then local");
  for (const std::size_t n : {1024, 4096, 16384}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      std::printf("%7zu %5zu", n, static_cast<std::size_t>(seed));
      for (const bool local : {false, true}) {
        const double start = cpu_seconds();
        Case c("uniform", n, seed, PlaneStart::random);
        if (local) remove_shortest_edges(c.domain);
        OptimizeOptions options;
        options.seed = seed;
        options.scope = local ? Scope::two_ring : Scope::global;
        options.target_delta = 0.925;
        options.max_iterations = 1000;
        const OptimizeResult result = optimize(c.domain, options);
        std::printf("  %7.3f s %4d its%s", cpu_seconds() - start, result.last.iteration,
                    result.reason == StopReason::target_reached ? "" : "!");
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> parts;
  std::size_t largest = 1048576;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--max-n" && i + 1 < argc)
      largest = std::strtoull(argv[++i], nullptr, 10);
    else
      parts.push_back(word);
  }
  const auto wanted = [&](const std::string& part) {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  if (wanted("quality")) quality();
  if (wanted("adaptive")) adaptive();
  if (wanted("speed")) speed(largest);
  if (wanted("target")) target();
}
