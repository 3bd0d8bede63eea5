// bench-scaling: what optimization costs as n grows, each row in a process of its own.
//   bench-scaling [PREFIX [LARGEST]]     writes PREFIX.csv and PREFIX.svg; LARGEST n (default 100000). Models
//   are those in the folder named by FPO_MODELS (default ../shared/models) that are there.
//
// us_per_move: microseconds of a global move, the first iteration left out; with tiles of all from the
// samples to the last diagram, over all moves. to_90, to_92: seconds from samples to delta .90 and .92, the
// first diagram included (-: not within 100 iterations or 3 million moves). Times are those of the clock, so
// run it on an idle machine. peak: memory of the process at its largest, and that per sample.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fpo/optimize.h"
#include "fpo/plane/plane_domain.h"
#include "fpo/plane/plane_sizing.h"
#include "fpo/surface/surface_domain.h"
#include "fpo/tiles/tiled_optimize.h"
#include "geom/shapes/shapes.h"
#include "io/atomic_file.h"
#include "io/chart.h"
#include "io/mesh_io.h"
#include "tests/bench/models.h"
#include "tools/worded.h"

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Figures {
  std::size_t facets = 0;
  double us_per_move = 0, to_90 = -1, to_92 = -1;
};

struct Job {
  std::string surface, engine;
  std::size_t n;
  std::function<Figures(const Job&)> run;
  int threads = 1;
};

fpo::OptimizeOptions options_for(std::size_t n) {
  fpo::OptimizeOptions options;
  options.max_iterations = static_cast<int>(std::clamp<std::size_t>(3'000'000 / n, 3, 100));
  options.target_delta = 0.92;
  return options;
}

/// Optimizes until delta .92.
Figures optimized(fpo::Domain& domain, std::size_t n, double start) {
  Figures figures;
  double first = 0, last = 0;
  int iterations = 0;
  fpo::OptimizeOptions options = options_for(n);
  options.on_iteration = [&](const fpo::IterationReport& r) {
    last = now();
    if (r.iteration == 1) first = last;
    if (r.delta > 0.9 && figures.to_90 < 0) figures.to_90 = last - start;
    if (r.delta > 0.92 && figures.to_92 < 0) figures.to_92 = last - start;
    iterations = r.iteration;
  };
  optimize(domain, options);
  figures.us_per_move = 1e6 * (last - first) / (static_cast<double>(n) * std::max(iterations - 1, 1));
  return figures;
}

Figures in_tiles(const geom::TriMesh& mesh, const Job& job) {
  const fpo::Sizing sizing = fpo::Sizing::uniform(fpo::hexagonal_spacing(mesh.area(), job.n));
  auto samples = fpo::random_samples(mesh, job.n, 1);
  Figures figures;
  figures.facets = mesh.num_facets();
  const double start = now();
  fpo::OptimizeOptions options = options_for(job.n);
  options.order = fpo::VisitOrder::in_turn;
  options.on_iteration = [&](const fpo::IterationReport& r) {
    if (r.delta > 0.9 && figures.to_90 < 0) figures.to_90 = now() - start;
    if (r.delta > 0.92 && figures.to_92 < 0) figures.to_92 = now() - start;
  };
  fpo::TileOptions tiles;
  tiles.threads = job.threads;
  fpo::SurfaceOptions surface;
  surface.threads = job.threads;
  fpo::OptimizeResult result;
  optimize_in_tiles({mesh, sizing, std::move(samples), surface}, tiles, options, result);
  figures.us_per_move = 1e6 * (now() - start) / static_cast<double>(result.moves);
  return figures;
}

Figures on_surface(const geom::TriMesh& mesh, const Job& job) {
  if (job.engine == "tiles") return in_tiles(mesh, job);
  auto samples = fpo::random_samples(mesh, job.n, 1);
  const double start = now();
  fpo::SurfaceOptions options;
  options.engine = job.engine == "search" ? fpo::Engine::search : fpo::Engine::triangulation;
  fpo::SurfaceDomain domain(mesh, samples, options);
  Figures figures = optimized(domain, job.n, start);
  figures.facets = mesh.num_facets();
  return figures;
}

Figures on_sphere(const Job& job) {  // about as many facets as samples
  int size = 1;
  while (geom::make_shape("sphere", size).num_facets() < job.n) size += 1 + size / 4;
  return on_surface(geom::make_shape("sphere", size), job);
}
Figures on_cube(const Job& job) { return on_surface(geom::make_shape("cube", 1), job); }

Figures on_torus(const Job& job) {
  const geom::FlatTorus torus({1, 1});
  const auto sizing = fpo::named_sizing("uniform", torus);
  const fpo::PlaneDensity density(*sizing, torus);
  const double start = now();
  fpo::PlaneDomain domain(torus, *sizing, density.edge_length_scale(job.n),
                          fpo::initial_plane_samples(density, job.n, 1, fpo::best_plane_start(true)));
  return optimized(domain, job.n, start);
}

std::vector<Job> jobs_up_to(std::size_t largest) {
  std::vector<Job> jobs;
  for (const bench::Model& model : bench::models_of_figure_10()) {
    const auto run = [file = model.file](const Job& job) { return on_surface(io::read_mesh(file), job); };
    for (const char* engine : {"search", "triangulation"})
      jobs.push_back({model.name, engine, model.samples, run});
    if (model.samples > 3000)
      for (const int threads : {1, 2}) jobs.push_back({model.name, "tiles", model.samples, run, threads});
  }
  for (std::size_t n = 1000; n <= largest; n *= 10) {
    jobs.push_back({"sphere", "search", n, on_sphere});
    if (n <= 10'000) jobs.push_back({"sphere", "triangulation", n, on_sphere});
    if (n > 1000)
      for (const int threads : {1, 2}) jobs.push_back({"sphere", "tiles", n, on_sphere, threads});
    jobs.push_back({"cube", "search", n, on_cube});
    if (n > 1000) jobs.push_back({"cube", "tiles", n, on_cube, 2});
    jobs.push_back({"torus", "plane", n, on_torus});
  }
  return jobs;
}

struct Row {
  Job job;
  Figures figures;
  double peak_mib = 0;
};

/// In a child process, so that the memory is that of this job; nothing if it fails.
std::optional<Row> run_apart(const Job& job) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    const Figures figures = job.run(job);
    const bool written = write(ends[1], &figures, sizeof figures) == sizeof figures;
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  Row row{job, {}, 0};
  const bool complete = read(ends[0], &row.figures, sizeof row.figures) == sizeof row.figures;
  close(ends[0]);
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0 || !complete) return std::nullopt;
  row.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024;
  return row;
}

std::string seconds(double value, const char* none) {
  return value < 0 ? none : tools::worded("%.2f", value);
}

std::string csv_line(const Row& r) {
  return tools::worded("%s,%zu,%zu,%s,%d,%.3f,%s,%s,%.1f\n", r.job.surface.c_str(), r.figures.facets, r.job.n,
                       r.job.engine.c_str(), r.job.threads, r.figures.us_per_move,
                       seconds(r.figures.to_90, "").c_str(), seconds(r.figures.to_92, "").c_str(),
                       r.peak_mib);
}

/// Microseconds a move against n, a curve for each family that grows.
io::Chart chart_of(const std::vector<Row>& rows) {
  std::map<std::string, std::vector<geom::Vec2>> curves;
  for (const Row& r : rows)
    curves[r.job.surface + ", " + r.job.engine + (r.job.threads > 1 ? ", 2 threads" : "")].emplace_back(
        static_cast<double>(r.job.n), r.figures.us_per_move);
  io::Chart chart;
  chart.title = "Microseconds a move";
  chart.x = {.label = "samples", .scale = io::Axis::Scale::logarithmic};
  chart.y = {.label = "us", .scale = io::Axis::Scale::logarithmic};
  const std::array<const char*, 7> colours = {"#1d4f91", "#b3402a", "#2d7d46", "#7a4f9e",
                                              "#c28a00", "#00838f", "#6d6d6d"};
  std::size_t next = 0;
  for (auto& [name, points] : curves)
    if (points.size() > 1)
      chart.series.push_back({.points = points, .name = name, .colour = colours[next++ % colours.size()]});
  return chart;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string prefix = argc > 1 ? argv[1] : "";
  const std::size_t largest = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 100'000;
  std::printf("%-9s %8s %8s %-13s %7s %12s %8s %8s %9s %10s\n", "surface", "facets", "n", "engine", "threads",
              "us_per_move", "to_90 s", "to_92 s", "peak MiB", "B a sample");
  std::string csv = "surface,facets,n,engine,threads,us_per_move,to_90_s,to_92_s,peak_mib\n";
  std::vector<Row> rows;
  for (const Job& job : jobs_up_to(largest)) {
    std::fflush(stdout);
    const std::optional<Row> row = run_apart(job);
    if (!row) {
      std::printf("%s %zu %s failed\n", job.surface.c_str(), job.n, job.engine.c_str());
      continue;
    }
    rows.push_back(*row);
    csv += csv_line(*row);
    std::printf("%-9s %8zu %8zu %-13s %7d %12.2f %8s %8s %9.1f %10.0f\n", job.surface.c_str(),
                row->figures.facets, job.n, job.engine.c_str(), job.threads, row->figures.us_per_move,
                seconds(row->figures.to_90, "-").c_str(), seconds(row->figures.to_92, "-").c_str(),
                row->peak_mib, row->peak_mib * 1048576 / static_cast<double>(job.n));
  }
  if (prefix.empty()) return 0;
  io::write_file(prefix + ".csv", csv);
  if (rows.size() > 1) io::draw_chart(chart_of(rows)).save(prefix + ".svg");
  std::printf("wrote %s.csv and %s.svg\n", prefix.c_str(), prefix.c_str());
}
