// Convergence and runtimes as charts: figures 10 and 11 of the paper.
//   bench-convergence FOLDER [ITERATIONS] [MODEL N]...   writes FOLDER/convergence.svg, runtime.svg and
//   convergence.csv; the models (default: those of figure 10 that are there) are taken from the folder named
//   by FPO_MODELS (default ../shared/models).
// Left: delta and mean delta by iteration, the mean over the models, for four ways. Runtimes: CPU seconds
// until then, per sample.

#include "tools/convergence.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/atomic_file.h"
#include "io/mesh_io.h"
#include "tests/bench/models.h"
#include "tools/worded.h"

namespace {

using tools::Convergence;

std::string table(std::span<const Convergence> curves) {
  std::string csv = "way,iteration,delta,mean_delta,us_per_sample\n";
  for (std::size_t w = 0; w < curves.size(); ++w) {
    for (std::size_t i = 0; i < curves[w].delta.size(); ++i)
      csv += tools::worded("%s,%zu,%.6f,%.6f,%.3f\n", tools::ways[w].name, i, curves[w].delta[i],
                           curves[w].mean_delta[i], curves[w].microseconds[i]);
  }
  return csv;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 0;  // `make bench` runs every benchmark without arguments
  const std::filesystem::path folder = argv[1];
  const int iterations = argc > 2 ? std::atoi(argv[2]) : 100;
  std::vector<bench::Model> models = bench::models_of_figure_10();
  if (argc > 3) models.clear();
  for (int i = 3; i + 1 < argc; i += 2)
    models.push_back({argv[i], bench::model_file(argv[i]), std::strtoull(argv[i + 1], nullptr, 10)});

  std::vector<std::vector<Convergence>> runs(tools::ways.size());
  for (const bench::Model& model : models) {
    const geom::TriMesh mesh = io::read_mesh(model.file);
    for (std::size_t w = 0; w < runs.size(); ++w)
      runs[w].push_back(tools::converge(mesh, model.samples, 1, tools::ways[w], {.iterations = iterations}));
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
