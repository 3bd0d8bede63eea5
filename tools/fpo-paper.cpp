// fpo-paper: the paper's tables and figures again, with its own figures beside them.

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "io/atomic_file.h"
#include "tools/cli.h"
#include "tools/paper_page.h"

namespace {

int paper(tools::CommandLine& cli) {
  tools::PaperOptions options;
  std::filesystem::path folder;
  cli.describe("FOLDER",
               "Runs the experiments of the paper's tables 2 to 4 and figures 7 to 11 for those of its "
               "models that are "
               "in FOLDER, by their names: eight.obj, venus.ply, ...");
  cli.path({.name = "output",
            .letter = 'o',
            .value = "DIR",
            .help = "where index.html and tables.md go",
            .required = true},
           folder);
  cli.custom({.name = "methods",
              .value = "NAMES",
              .help = "only these methods of table 1, separated by commas: cvt,fpo",
              .standard = "all"},
             [&](const std::string& text) { options.methods = tools::methods_named(text); });
  cli.integer(
      {.name = "sets", .value = "K", .help = "sets a spectrum of figure 7; half as many in figures 8, 9"},
      options.sets, 1, 1000);
  cli.number(
      {.name = "radius", .value = "R", .help = "look at pairs of samples up to so many spacings apart"},
      options.radius, 1, 50);
  cli.integer({.name = "iterations",
               .value = "MAX",
               .help = "at most so many everywhere",
               .standard = "each method's own number"},
              options.iterations, 0, 1'000'000);
  cli.toggle({.name = "tables", .help = "tables 2 to 4"}, options.tables);
  cli.toggle({.name = "spectra", .help = "figures 7 to 9"}, options.spectra);
  cli.toggle({.name = "convergence", .help = "figure 10, left"}, options.convergence);
  cli.toggle({.name = "runtimes", .help = "figures 10, right, and 11"}, options.runtimes);
  options.models = cli.parse(1, 1).front();
  options.seed = cli.seed();
  options.threads = cli.threads();
  if (!cli.quiet())
    options.progress = [](const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); };

  std::error_code error;
  std::filesystem::create_directories(folder, error);
  geom::require(!error, "cannot make " + folder.string() + ": " + error.message());
  const std::filesystem::path page = folder / "index.html", tables = folder / "tables.md";
  io::require_writable(page);
  io::require_writable(tables);

  const auto start = std::chrono::steady_clock::now();
  const tools::PaperResults results = tools::run_paper(options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const tools::PaperHeader header{cli.command(), FPO_VERSION, seconds.count()};
  tools::paper_page(results, header).save(page);
  io::write_file(tables, tools::paper_markdown(results, header));
  for (const tools::PaperModel& model : results.models)
    if (model.file.empty()) std::printf("missing %s\n", model.name.c_str());
  std::printf("rows %zu\nspectra %zu\nseconds %.1f\ncpu_seconds %.1f\nwrote %s %s\n", results.runs.size(),
              results.spectra.size(), header.seconds, results.cpu_seconds, page.c_str(), tables.c_str());
  return tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-paper", argc, argv, paper); }
