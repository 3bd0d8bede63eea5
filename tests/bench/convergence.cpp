// Convergence and runtimes as charts: figures 10 and 11 of the paper.
//   bench-convergence FOLDER [ITERATIONS] [MODEL...]   writes FOLDER/convergence.svg, runtime.svg and
//   convergence.csv; the models (default: eight, venus, homer, bunny) are taken from the folder named by
//   FPO_MODELS (default ../shared/models), those that are missing are named.
// Left: delta and mean delta by iteration, the mean over the models, for four ways. Runtimes: CPU seconds
// until then, per sample.

#include "tools/convergence.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "fpo/surface/surface_domain.h"
#include "io/atomic_file.h"
#include "io/mesh_io.h"

namespace {

using tools::Convergence;

Convergence run(const geom::TriMesh& mesh, std::size_t n, const tools::Way& way, int iterations) {
  const auto samples = fpo::random_samples(mesh, n, 1);
  const double start = tools::thread_seconds();
  fpo::SurfaceDomain domain(mesh, samples);
  return tools::converge(domain, way, start, {.iterations = iterations});
}

std::string table(std::span<const Convergence> curves) {
  std::string csv = "way,iteration,delta,mean_delta,us_per_sample\n";
  for (std::size_t w = 0; w < curves.size(); ++w) {
    for (std::size_t i = 0; i < curves[w].delta.size(); ++i) {
      char line[160];
      std::snprintf(line, sizeof line, "%s,%zu,%.6f,%.6f,%.3f\n", tools::ways[w].name, i, curves[w].delta[i],
                    curves[w].mean_delta[i], curves[w].microseconds[i]);
      csv += line;
    }
  }
  return csv;
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

  std::vector<std::vector<Convergence>> runs(tools::ways.size());
  for (const std::string& model : models) {
    const auto file =
        std::filesystem::path(models_folder ? models_folder : "../shared/models") / (model + ".obj");
    if (!std::filesystem::exists(file) || !sizes.contains(model)) {
      std::printf("missing: %s\n", file.c_str());
      continue;
    }
    const geom::TriMesh mesh = io::read_mesh(file);
    for (std::size_t w = 0; w < runs.size(); ++w)
      runs[w].push_back(run(mesh, sizes.at(model), tools::ways[w], iterations));
  }
  if (runs.front().empty()) return 1;

  std::vector<Convergence> curves;
  for (const std::vector<Convergence>& models_runs : runs) {
    const Convergence& c = curves.emplace_back(tools::mean(models_runs));
    const std::size_t last = c.delta.size() - 1, early = std::min<std::size_t>(10, last);
    std::printf("%-13s  10: %.4f %.4f %7.1f us   %zu: %.4f %.4f %7.1f us\n",
                tools::ways[curves.size() - 1].name, c.delta[early], c.mean_delta[early],
                c.microseconds[early], last, c.delta[last], c.mean_delta[last], c.microseconds[last]);
  }
  std::filesystem::create_directories(folder);
  io::draw_chart(tools::convergence_chart(tools::ways, curves)).save(folder / "convergence.svg");
  io::draw_chart(tools::runtime_chart(tools::ways, curves)).save(folder / "runtime.svg");
  io::write_file(folder / "convergence.csv", table(curves));
  std::printf("wrote %s/convergence.svg, runtime.svg, convergence.csv\n", folder.c_str());
}
