// Convergence and runtimes as charts: figures 10 and 11 of the paper.
//   bench-convergence FOLDER [ITERATIONS] [MODEL...]   writes FOLDER/convergence.svg, runtime.svg and
//   convergence.csv; the models (default: eight, venus, homer, bunny) are taken from the folder named by
//   FPO_MODELS (default ../shared/models), those that are missing are named.
// Left: delta and mean delta by iteration, the mean over the models, for four ways. Runtimes: CPU seconds
// until then, per sample.

#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "fpo/optimize.h"
#include "fpo/shortest_edge.h"
#include "fpo/surface_domain.h"
#include "io/atomic_file.h"
#include "io/chart.h"
#include "io/mesh_io.h"

namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Way {
  std::string name, colour;
  bool shortest_edges;
  fpo::Scope scope;
};

const std::vector<Way> ways = {{"global", "#1d4f91", false, fpo::Scope::global},
                               {"local", "#2a8a57", false, fpo::Scope::two_ring},
                               {"SER + global", "#c0392b", true, fpo::Scope::global},
                               {"SER + local", "#d98a00", true, fpo::Scope::two_ring}};

/// By iteration: sums over the models.
struct Curve {
  std::vector<double> delta, mean_delta, microseconds_per_sample;
};

void run(const geom::TriMesh& mesh, std::size_t n, const Way& way, int iterations, Curve& sum) {
  const auto samples = fpo::random_samples(mesh, n, 1);
  double start = cpu_seconds();
  fpo::SurfaceDomain domain(mesh, samples);
  if (way.shortest_edges) fpo::remove_shortest_edges(domain);
  fpo::OptimizeOptions options;
  options.max_iterations = iterations;
  options.target_delta = 2;
  options.scope = way.scope;
  options.order = fpo::VisitOrder::in_turn;
  options.on_iteration = [&](const fpo::IterationReport& r) {
    const auto i = static_cast<std::size_t>(r.iteration);
    sum.delta[i] += r.delta;
    sum.mean_delta[i] += r.mean_delta;
    sum.microseconds_per_sample[i] += 1e6 * (cpu_seconds() - start) / static_cast<double>(n);
  };
  fpo::optimize(domain, options);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 0;  // `make bench` runs every benchmark without arguments
  const std::filesystem::path folder = argv[1];
  const int iterations = argc > 2 ? std::atoi(argv[2]) : 100;
  const std::map<std::string, std::size_t> sizes = {
      {"eight", 1700}, {"venus", 1700}, {"homer", 7900}, {"bunny", 6300}, {"elephant", 11300}};
  std::vector<std::string> models(argv + std::min(argc, 3), argv + argc);
  if (models.empty()) models = {"eight", "venus", "homer", "bunny"};
  const char* models_folder = std::getenv("FPO_MODELS");

  const auto length = static_cast<std::size_t>(iterations) + 1;
  std::vector<Curve> curves(
      ways.size(), {std::vector<double>(length), std::vector<double>(length), std::vector<double>(length)});
  double count = 0;
  for (const std::string& model : models) {
    const auto file =
        std::filesystem::path(models_folder ? models_folder : "../shared/models") / (model + ".obj");
    if (!std::filesystem::exists(file) || !sizes.contains(model)) {
      std::printf("missing: %s\n", file.c_str());
      continue;
    }
    const geom::TriMesh mesh = io::read_mesh(file);
    for (std::size_t w = 0; w < ways.size(); ++w) run(mesh, sizes.at(model), ways[w], iterations, curves[w]);
    ++count;
  }
  if (count == 0) return 1;

  io::Chart convergence{"", {"iteration"}, {"delta (thick), mean delta (thin)", 0.5, 0.95}, {}, {}};
  io::Chart runtime{"", {"iteration"}, {"microseconds a sample"}, {}, {}};
  std::string csv = "way,iteration,delta,mean_delta,us_per_sample\n";
  for (std::size_t w = 0; w < ways.size(); ++w) {
    io::Series delta{{}, ways[w].name}, mean{{}}, time{{}, ways[w].name};
    delta.colour = mean.colour = time.colour = ways[w].colour;
    delta.width = 2, mean.width = 0.9;
    for (std::size_t i = 0; i < length; ++i) {
      const auto x = static_cast<double>(i);
      const double d = curves[w].delta[i] / count, m = curves[w].mean_delta[i] / count,
                   us = curves[w].microseconds_per_sample[i] / count;
      delta.points.push_back({x, d});
      mean.points.push_back({x, m});
      time.points.push_back({x, us});
      char line[160];
      std::snprintf(line, sizeof line, "%s,%zu,%.6f,%.6f,%.3f\n", ways[w].name.c_str(), i, d, m, us);
      csv += line;
    }
    const std::size_t last = length - 1;
    std::printf("%-13s  10: %.4f %.4f %7.1f us   %zu: %.4f %.4f %7.1f us\n", ways[w].name.c_str(),
                delta.points[std::min<std::size_t>(10, last)].y(),
                mean.points[std::min<std::size_t>(10, last)].y(),
                time.points[std::min<std::size_t>(10, last)].y(), last, delta.points[last].y(),
                mean.points[last].y(), time.points[last].y());
    convergence.series.push_back(std::move(delta));
    convergence.series.push_back(std::move(mean));
    runtime.series.push_back(std::move(time));
  }
  std::filesystem::create_directories(folder);
  io::draw_chart(convergence).save(folder / "convergence.svg");
  io::draw_chart(runtime).save(folder / "runtime.svg");
  io::write_file(folder / "convergence.csv", csv);
  std::printf("wrote %s/convergence.svg, runtime.svg, convergence.csv\n", folder.c_str());
}
