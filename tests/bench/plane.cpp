// bench-plane: quality and speed of farthest point optimization on the flat torus.
//
//   bench-plane [quality] [start] [adaptive] [border] [speed] [target] [--max-n N]      default: all, N =
//   1048576
//
// Times are CPU seconds of one thread.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "fpo/measure/quality.h"
#include "fpo/optimize.h"
#include "fpo/plane/plane_angles.h"
#include "fpo/plane/plane_domain.h"
#include "fpo/plane/plane_quality.h"
#include "fpo/plane/rectangle.h"
#include "fpo/remesh/pipeline.h"
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

/// A run of 200 uniform iterations.
struct Convergence {
  int first_925 = 999, first_93 = 999;  ///< iteration with delta >= .925, > .93; 999: none
  PlaneQuality quality;
};

Convergence converge(std::size_t n, std::uint64_t seed, PlaneStart start, VisitOrder order) {
  Case c("uniform", n, seed, start);
  Convergence result;
  OptimizeOptions options;
  options.seed = seed;
  options.order = order;
  options.max_iterations = 200;
  options.target_delta = 1;
  options.on_iteration = [&](const IterationReport& r) {
    if (result.first_925 == 999 && r.delta >= 0.925) result.first_925 = r.iteration;
    if (result.first_93 == 999 && r.delta > 0.93) result.first_93 = r.iteration;
  };
  optimize(c.domain, options);
  result.quality = plane_quality(c.domain);
  return result;
}

void quality() {
  std::printf(
      "\nuniform, default start and order, global, 200 iterations; the first with delta >= .925, > .93\n");
  std::printf("%7s %5s %12s %12s %10s %10s %8s\n", "n", "seed", "delta .925", "delta .93", "delta@200",
              "mean@200", "theta");
  for (const std::size_t n : {1024, 4096}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const Convergence c = converge(n, seed, best_plane_start(true), best_visit_order(true));
      std::printf("%7zu %5zu %12d %12d %10.4f %10.4f %8.2f\n", n, static_cast<std::size_t>(seed), c.first_925,
                  c.first_93, c.quality.delta, c.quality.mean_delta, c.quality.min_angle);
    }
  }
}

/// Which start and which order? Over 16 seeds.
void start() {
  std::printf("\nuniform, 16 seeds, 200 iterations: runs that reach .925, .93, and mean .931\n");
  std::printf("%7s %-11s %-14s %6s %7s %6s %6s %11s\n", "n", "start", "order", ".925", "median", ".93",
              ".931", "least delta");
  constexpr std::size_t seeds = 16;
  for (const std::size_t n : {1024, 4096}) {
    for (const PlaneStart from : {PlaneStart::random, PlaneStart::stratified}) {
      for (const VisitOrder order : {VisitOrder::shuffled_once, VisitOrder::shuffled}) {
        std::vector<int> first;
        std::size_t reach_93 = 0, reach_mean = 0;
        double least = 1;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
          const Convergence c = converge(n, seed, from, order);
          first.push_back(c.first_925);
          reach_93 += c.first_93 < 999;
          reach_mean += c.quality.mean_delta >= 0.931;
          least = std::min(least, c.quality.delta);
        }
        std::sort(first.begin(), first.end());
        std::printf("%7zu %-11s %-14s %6zu %7d %6zu %6zu %11.4f\n", n,
                    from == PlaneStart::random ? "random" : "stratified",
                    order == VisitOrder::shuffled ? "drawn anew" : "one for all",
                    static_cast<std::size_t>(
                        std::count_if(first.begin(), first.end(), [](int i) { return i < 999; })),
                    first[seeds / 2], reach_93, reach_mean, least);
        std::fflush(stdout);
      }
    }
  }
}

void adaptive() {
  std::printf(
      "\nadaptive, default start, order and weights, local, 100 iterations, then angle optimization; before "
      "-> "
      "after\n");
  std::printf("%-8s %6s %5s %7s %8s %16s %8s %16s %4s %7s\n", "field", "n", "seed", "slope", "CV d/h",
              "delta", "mean", "theta", "<30", "hidden");
  for (const std::string name : {"waves5", "spot5", "band5", "waves11", "spot11", "band11"}) {
    for (const std::size_t n : {4096, 16384}) {
      for (std::uint64_t seed = 1; seed <= (n == 4096 ? 3 : 1); ++seed) {
        Case c(name, n, seed, best_plane_start(false));
        OptimizeOptions options;
        options.seed = seed;
        options.scope = Scope::two_ring;
        options.order = best_visit_order(false);
        optimize(c.domain, options);
        const PlaneQuality before = plane_quality(c.domain);
        optimize_angles(c.domain);
        const PlaneQuality q = plane_quality(c.domain);
        std::printf("%-8s %6zu %5zu %7.3f %8.4f %6.4f -> %6.4f %8.4f %6.2f -> %6.2f %4zu %7zu\n",
                    name.c_str(), n, static_cast<std::size_t>(seed), q.grading_slope, q.spacing_variation,
                    before.delta, q.delta, q.mean_delta, before.min_angle, q.min_angle, q.angles_below_30,
                    q.hidden);
        std::fflush(stdout);
      }
    }
  }
}

/// The radius of the largest empty circle about a location on the border, to a hundredth of the spacing.
double largest_border_hole(const geom::Vec2& size, const std::vector<SurfaceSample>& samples) {
  const double step = hexagonal_spacing(size.prod(), samples.size()) / 100;
  const double length = 2 * size.sum();
  double largest2 = 0;
  for (double s = 0; s < length; s += step) {
    const double half = std::fmod(s, length / 2);
    geom::Vec2 x = half < size.x() ? geom::Vec2(half, 0) : geom::Vec2(size.x(), half - size.x());
    if (s >= length / 2) x = size - x;
    double least2 = 1e300;
    for (const SurfaceSample& y : samples)
      least2 = std::min(least2, (y.position.head<2>() - x).squaredNorm());
    largest2 = std::max(largest2, least2);
  }
  return std::sqrt(largest2);
}

void border() {
  std::printf(
      "\na rectangle with a border, uniform, global, 100 iterations: where farthest points are looked for; "
      "lengths / d_max\n");
  std::printf("%7s %-8s %5s %8s %8s %12s %10s %8s\n", "n", "corners", "seed", "delta", "mean", "border hole",
              "on border", "theta");
  const geom::Vec2 size(1.5, 1);
  const geom::TriMesh rectangle = rectangle_mesh(size);
  for (const geom::CornerTypes corners : {geom::CornerTypes::c_only, geom::CornerTypes::all}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      RemeshOptions options;
      options.num_samples = 1024;
      options.seed = seed;
      options.surface.corners = corners;
      options.optimize.target_delta = 2;
      const RemeshResult r = remesh(rectangle, options);
      const auto on_border = std::count_if(r.samples.begin(), r.samples.end(), [&](const SurfaceSample& s) {
        return s.position.x() == 0 || s.position.y() == 0 || s.position.x() == size.x() ||
               s.position.y() == size.y();
      });
      std::printf("%7zu %-8s %5zu %8.4f %8.4f %12.4f %10td %8.2f\n", r.samples.size(),
                  corners == geom::CornerTypes::all ? "all" : "c", static_cast<std::size_t>(seed),
                  r.optimization.last.delta, r.optimization.last.mean_delta,
                  largest_border_hole(size, r.samples) / hexagonal_spacing(size.prod(), r.samples.size()),
                  on_border, fpo::quality(r.mesh, rectangle.area()).theta_min);
      std::fflush(stdout);
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
        options.order = best_visit_order(true);
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
  if (wanted("start")) start();
  if (wanted("adaptive")) adaptive();
  if (wanted("border")) border();
  if (wanted("speed")) speed(largest);
  if (wanted("target")) target();
}
