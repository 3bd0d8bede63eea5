// Microseconds of CPU time per FPO move on surfaces, and how moves after the first iteration were certified,
// in percent: in place with leeway, in place without, removed and inserted in the fast way, at least one of
// both in the general way (geom/dual/fast_way.h).
//   bench-surface MODEL.obj N [ITERATIONS] [search|triangulation] [c|all]     one row; without arguments: a
//   table for the models in the folder named by FPO_MODELS (default ../shared/models) that are there.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "fpo/optimize.h"
#include "fpo/surface/surface_domain.h"
#include "io/mesh_io.h"
#include "tests/bench/models.h"
#include "tools/convergence.h"

namespace {

struct Job {
  std::filesystem::path model;
  std::size_t n;
  int iterations = 10;
  fpo::SurfaceOptions options;
};

/// The shares of moves by each way, in percent.
void print_ways(const geom::DualWays& before, const geom::DualWays& after) {
  const double in_place = static_cast<double>(after.in_place - before.in_place);
  const double with_leeway = static_cast<double>(after.with_leeway - before.with_leeway);
  const double removed = static_cast<double>(after.fast_removals + after.general_removals -
                                             before.fast_removals - before.general_removals);
  const double general = static_cast<double>(std::max(after.general_removals - before.general_removals,
                                                      after.general_insertions - before.general_insertions));
  const double share = 100 / std::max(in_place + removed, 1.0);
  std::printf(" %7.1f %7.1f %7.1f %7.1f\n", share * with_leeway, share * (in_place - with_leeway),
              share * (removed - general), share * general);
}

/// CPU time of the first diagram, of a move in the first iteration, and of one in the later ones.
void measure(const Job& job) {
  const geom::TriMesh mesh = io::read_mesh(job.model);
  const auto samples = fpo::random_samples(mesh, job.n, 1);
  const double start = tools::thread_seconds();
  fpo::SurfaceDomain domain(mesh, samples, job.options);
  const double built = tools::thread_seconds();
  double after_first = 0;
  geom::DualWays ways;
  fpo::OptimizeOptions options;
  options.max_iterations = job.iterations;
  options.on_iteration = [&](const fpo::IterationReport& r) {
    if (r.iteration > 1) return;
    after_first = tools::thread_seconds();
    ways = domain.dual().ways();
  };
  const fpo::OptimizeResult result = fpo::optimize(domain, options);
  const double end = tools::thread_seconds();
  const double n = static_cast<double>(job.n);
  std::printf(
      "%-14s %8zu %8zu %-13s %-3s %9.1f %9.2f %9.2f   %.4f %.4f", job.model.stem().c_str(), mesh.num_facets(),
      job.n, job.options.engine == fpo::Engine::search ? "search" : "triangulation",
      job.options.corners == geom::CornerTypes::all ? "all" : "c", 1e3 * (built - start),
      1e6 * (after_first - built) / n, 1e6 * (end - after_first) / (n * std::max(job.iterations - 1, 1)),
      result.last.delta, result.last.mean_delta);
  print_ways(ways, domain.dual().ways());
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-14s %8s %8s %-13s %-3s %9s %9s %9s   delta  mean   leeway   place    fast general\n",
              "model", "facets", "samples", "engine", "cor", "build ms", "1st us", "later us");
  if (argc > 2) {
    Job job{argv[1], std::strtoull(argv[2], nullptr, 10), argc > 3 ? std::atoi(argv[3]) : 10, {}};
    if (argc > 4 && std::string(argv[4]) == "triangulation") job.options.engine = fpo::Engine::triangulation;
    if (argc > 5)
      job.options.corners =
          std::string(argv[5]) == "all" ? geom::CornerTypes::all : geom::CornerTypes::c_only;
    measure(job);
    return 0;
  }
  for (const bench::Model& model : bench::models_of_figure_10())
    for (const fpo::Engine engine : {fpo::Engine::search, fpo::Engine::triangulation}) {
      Job job{model.file, model.samples, 10, {}};
      job.options.engine = engine;
      measure(job);
    }
}
