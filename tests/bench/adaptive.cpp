// Time against quality: shortest edge removal or not, global or local farthest points.
//   bench-adaptive MODEL N [SIZING-FILE|-] [WEIGHT-SCALE, 0: best] [GRADATION] [SEED] [ITERATIONS]
// Two rows per method and checkpoint, without and with (+) angle optimization; seconds are CPU time since the
// samples were drawn.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "fpo/measure/quality.h"
#include "fpo/optimize.h"
#include "fpo/remesh/angles.h"
#include "fpo/remesh/extract.h"
#include "fpo/shortest_edge.h"
#include "fpo/surface/surface_domain.h"
#include "io/mesh_io.h"
#include "io/values.h"
#include "tools/convergence.h"

namespace {

struct Job {
  geom::TriMesh mesh;
  std::size_t n;
  std::uint64_t seed = 1;
  double weight_scale = 0;  ///< 0: the best of the scope
  fpo::Sizing sizing;
};

void row(const Job& job, fpo::SurfaceDomain& domain, const char* mark, int iteration, double seconds) {
  const geom::TriMesh remesh = fpo::extract(*domain.diagram(), job.n);
  const fpo::Quality q = fpo::quality(remesh, job.mesh.area());
  const fpo::IterationReport r = fpo::measure(domain);
  geom::Table<geom::VertexId, double> h;
  for (std::size_t i = 0; i < job.n; ++i) h.push_back(job.sizing.at(domain.sample(geom::SiteId(i))));
  const fpo::SizingFit fit = fpo::sizing_fit(remesh, h);
  std::printf("%s %4d %7.2f  %.4f %.4f  %.3f %.4f %5.2f %5.2f %6.2f %7.4f %6.2f  %.3f %.3f %.3f %zu\n", mark,
              iteration, seconds, r.delta, r.mean_delta, q.q_min, q.q_avg, q.theta_min, q.theta_min_avg,
              q.theta_max, q.theta_lt30_pct, q.v567_pct, fit.slope, fit.mean, fit.cv, domain.num_hidden());
}

void rows(const Job& job, fpo::SurfaceDomain& domain, int iteration, double seconds) {
  row(job, domain, " ", iteration, seconds);
  if (iteration == 0) return;
  fpo::SurfaceDomain copy = domain.rebuilt();
  const double start = tools::thread_seconds();
  fpo::optimize_angles(copy, {});
  row(job, copy, "+", iteration, seconds + tools::thread_seconds() - start);
}

void measure(const Job& job, bool shortest_edges, fpo::Scope scope, int iterations) {
  std::printf("%s%s\n", shortest_edges ? "SER + " : "", scope == fpo::Scope::global ? "global" : "local");
  fpo::SurfaceOptions surface;
  surface.weight_factor = job.weight_scale > 0 ? job.weight_scale : fpo::best_weight_factor(scope);
  const auto samples = fpo::random_samples(job.mesh, job.sizing, job.n, job.seed);
  double start = tools::thread_seconds();
  fpo::SurfaceDomain domain(job.mesh, job.sizing, samples, surface);
  if (shortest_edges) fpo::remove_shortest_edges(domain);
  fpo::OptimizeOptions options;
  options.max_iterations = iterations;
  options.target_delta = 2;
  options.scope = scope;
  options.order = fpo::VisitOrder::in_turn;
  options.on_iteration = [&](const fpo::IterationReport& r) {
    const double now = tools::thread_seconds();
    const int i = r.iteration;
    if (i == 0 || i == 5 || i == 10 || i == 20 || i == 30 || i == 60 || i == 100)
      rows(job, domain, i, now - start);
    start += tools::thread_seconds() - now;
  };
  fpo::optimize(domain, options);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::puts("skipped: bench-adaptive wants MODEL N");
    return 0;
  }
  const auto number = [&](int i, double standard) { return argc > i ? std::atof(argv[i]) : standard; };
  Job job{io::read_mesh(argv[1]), std::strtoull(argv[2], nullptr, 10), 1, number(4, 0),
          fpo::Sizing::uniform(1)};
  job.seed = static_cast<std::uint64_t>(number(6, 1));
  job.sizing = fpo::Sizing::uniform(fpo::hexagonal_spacing(job.mesh.area(), job.n));
  if (argc > 3 && std::string(argv[3]) != "-") {
    const auto rho = io::read_positive_values(argv[3], job.mesh.num_vertices());
    fpo::SizingLimits limits;
    limits.gradation = number(5, limits.gradation);
    job.sizing = fpo::fit_sizing(job.mesh, {rho.begin(), rho.end()}, job.n, limits);
  }
  std::printf(
      "  iter   secs  delta  mean    Qmin  Qavg   thmin thavg thmax   <30%%    V567   slope mean  cv    "
      "hidden\n");
  for (const bool ser : {false, true})
    for (const fpo::Scope scope : {fpo::Scope::global, fpo::Scope::two_ring})
      measure(job, ser, scope, argc > 7 ? std::atoi(argv[7]) : 100);
}
