// fuzz: the built fpo-remesh and fpo-quality on spoilt surfaces, one seed after the other, for a given time.
// Every run must end within ten seconds of processor time (60 with `make fuzz`, under sanitizers) with a
// result that holds or with one line that says why there is none. Most files get a few dozen samples: what
// goes wrong goes wrong with few, and of those more can be tried.

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <optional>

#include "geom/check.h"
#include "geom/repair/clean.h"
#include "io/mesh_io.h"
#include "tests/fixtures/program.h"
#include "tests/fuzz/mutator.h"
#include "tests/io/scratch_folder.h"
#include "tools/cli.h"
#include "tools/interrupt.h"

namespace {

namespace fs = std::filesystem;
using fixtures::ProgramResult;

constexpr std::uint64_t most_faults = 20;  // more tell nothing new
constexpr double most_wall_time = 20;      // in processor time: others work, too

/// What is wrong, in words.
struct Fault {
  std::string what;
};

void expect(bool condition, const std::string& what) {
  if (!condition) throw Fault{what};
}

std::string last_lines(const std::string& text) {
  return text.size() > 2000 ? "..." + text.substr(text.size() - 2000) : text;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> result;
  for (const auto& entry : fs::directory_iterator(folder))
    result[entry.path().filename().string()] = fixtures::ScratchFolder::read(entry.path());
  return result;
}

/// One seed: a mutant, the options that the seed draws, and what must hold.
class Trial {
 public:
  Trial(std::uint64_t seed, std::size_t time_limit)
      : time_limit_(time_limit), mutant_(fuzz::mutant(seed)), rng_(~seed) {
    draw_options();
  }

  /// Throws Fault.
  void run() {
    folder_.write(mutant_.name, mutant_.bytes);
    const ProgramResult remeshed = execute("fpo-remesh", options_);
    check_files(remeshed.code == 0);
    execute("fpo-quality", {mutant_.name});
    check_repair();
    if (remeshed.code != 0) return;
    // What was written can be read, and measured.
    if (output_ == "out.stl") return;  // single precision may have welded all there is
    const geom::TriMesh mesh = io::read_mesh(folder_ / output_);
    std::size_t repeated = 0;
    check_type(remeshed, geom::cleaned(io::read_mesh(folder_ / mutant_.name, repeated)).mesh, mesh);
    expect(mesh.num_vertices() == count_,
           "the remesh has " + std::to_string(mesh.num_vertices()) + " vertices");
    execute("fpo-quality", {output_, "--reference", mutant_.name});
    if (rng_.below(3) == 0) check_other_engine();
  }

  bool refused() const { return refused_; }
  double slowest() const { return slowest_; }  ///< seconds of one run
  void keep(const fs::path& path) const {
    fs::copy_file(folder_ / words_.front(), path.string() + fs::path(words_.front()).extension().string(),
                  fs::copy_options::overwrite_existing);
  }
  /// The last that was run; its input is what is kept.
  std::string command() const {
    std::string line = program_;
    for (const std::string& word : words_) line += " " + word;
    return line;
  }

 private:
  void draw_options() {
    count_ = rng_.below(4) == 0 ? 50 + rng_.below(151) : 10 + rng_.below(51);
    output_ = std::array{"out.obj", "out.off", "out.ply", "out.stl"}[rng_.below(4)];
    options_ = {mutant_.name,
                "-n",
                std::to_string(count_),
                "-o",
                output_,
                "--iterations",
                std::to_string(rng_.below(5)),
                "--seed",
                std::to_string(rng_.below(100))};
    const auto sometimes = [&](std::initializer_list<const char*> words) {
      if (rng_.below(3) == 0) options_.insert(options_.end(), words.begin(), words.end());
    };
    sometimes({"--corners", "all"});
    sometimes({"--sizing", rng_.below(2) == 0 ? "lfs" : "curvature"});
    sometimes({"--local"});
    sometimes({"--ser"});
    sometimes({"--no-optimize-angles"});
    sometimes({"--points", "out.xyz"});
    sometimes({"--rpd", "rpd.obj"});
    sometimes({"--picture", "out.svg"});
    sometimes({"--log", "log.csv"});
  }

  ProgramResult execute(const std::string& program, const std::vector<std::string>& arguments) {
    program_ = program;
    words_ = arguments;
    const double wall_time = most_wall_time * static_cast<double>(time_limit_);
    const ProgramResult result =
        fixtures::run_program(program, arguments, folder_.path(), wall_time / fixtures::slowness,
                              {.processor_seconds = time_limit_});
    slowest_ = std::max(slowest_, result.processor_seconds);
    expect(!result.timed_out, program + " takes too long");
    expect(result.code == 0 || result.code == 2,
           program + " ended with code " + std::to_string(result.code) + ": " + last_lines(result.err));
    if (result.code == 2) {
      refused_ = true;
      expect(result.lines_on_stderr() == 1, program + " complains in other than one line: " + result.err);
      expect(result.out.empty(), program + " printed results and refused");
    }
    return result;
  }

  /// All outputs or none, and nothing that is half done.
  void check_files(bool wanted) const {
    const auto files = files_in(folder_.path());
    std::size_t outputs = 0;
    for (const auto& option : options_)
      outputs += option.starts_with("out.") || option == "rpd.obj" || option == "log.csv";
    expect(files.size() == 1 + (wanted ? outputs : 0), "there are files missing or too many");
  }

  /// A manifold of the input's type, or somebody has said that it is not.
  static void check_type(const ProgramResult& run, const geom::TriMesh& input, const geom::TriMesh& remesh) {
    const geom::Topology in = geom::topology(input), out = geom::topology(remesh);
    const bool right = out.manifold() && out.unreferenced_vertices == 0 && in.euler == out.euler &&
                       in.components == out.components && in.boundary_loops == out.boundary_loops;
    expect(right || run.err.find("warning: ") != std::string::npos,
           "the remesh is of another type, and nothing says so");
    expect(4 * out.unreferenced_vertices <= remesh.num_vertices(), "much of the surface is missing");
  }

  /// A surface as exporters spoil it, as it is and repaired.
  void check_repair() {
    if (rng_.below(4) != 0) return;
    const fuzz::Mutant file = fuzz::export_fault(rng_.bits());
    folder_.write(file.name, file.bytes);
    const std::string count = rng_.below(4) == 0 ? "150" : "60";
    std::vector<std::string> arguments{file.name, "-n", count, "--iterations", "3", "-o", "e.obj"};
    const ProgramResult plain = execute("fpo-remesh", arguments);
    if (plain.code == 0) {
      const geom::TriMesh cleaned = geom::cleaned(io::read_mesh(folder_ / file.name)).mesh;
      check_type(plain, cleaned, io::read_mesh(folder_ / "e.obj"));
      expect(geom::topology(cleaned).manifold() || plain.err.find("--repair") != std::string::npos,
             "a fault of the input is not named with the option that mends it");
    }
    arguments.insert(arguments.end(), {"--repair", "--repaired", "r.obj"});
    const ProgramResult repaired = execute("fpo-remesh", arguments);
    if (repaired.code == 0) {
      const geom::TriMesh surface = io::read_mesh(folder_ / "r.obj");
      const geom::Topology t = geom::topology(surface);
      expect(t.manifold() && t.boundary_edges == 0, "repair leaves no closed manifold");
      check_type(repaired, surface, io::read_mesh(folder_ / "e.obj"));
    }
    for (const char* name : {"export.ply", "e.obj", "r.obj"}) fs::remove(folder_ / name);
  }

  void check_other_engine() {
    const auto before = files_in(folder_.path());
    std::vector<std::string> options = options_;
    options.insert(options.end(), {"--engine", "triangulation"});
    execute("fpo-remesh", options);
    for (const auto& [name, bytes] : files_in(folder_.path()))
      if (name != "log.csv") expect(before.at(name) == bytes, "the engines disagree about " + name);
  }

  std::size_t time_limit_;
  fixtures::ScratchFolder folder_;
  fuzz::Mutant mutant_;
  geom::Rng rng_;
  std::vector<std::string> options_, words_;
  std::string output_, program_;
  std::size_t count_ = 0;
  bool refused_ = false;
  double slowest_ = 0;
};

int fuzz_tools(tools::CommandLine& cli) {
  double seconds = 60, slowest = 0;
  std::uint64_t count = UINT64_MAX, time_limit = 10, slowest_seed = 0;
  fs::path keep = fs::temp_directory_path();
  cli.describe("", "Runs fpo-remesh and fpo-quality on spoilt surfaces. --seed is the first one's seed.");
  cli.number({.name = "seconds", .value = "T", .help = "for so long"}, seconds, 0, 1e9);
  cli.integer({.name = "time-limit", .value = "T", .help = "seconds of processor time for one run of a tool"},
              time_limit, 1, 1000000);
  cli.integer({.name = "count", .value = "N", .help = "so many at most", .standard = "any number"}, count, 1,
              UINT64_MAX);
  cli.path({.name = "keep", .value = "FOLDER", .help = "where files that show a fault are kept"}, keep);
  cli.parse(0, 0);

  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::uint64_t trials = 0, refused = 0, faults = 0;
  for (; trials < count && faults < most_faults && elapsed() < seconds && !tools::interrupt_flag();
       ++trials) {
    const std::uint64_t seed = cli.seed() + trials;
    Trial trial(seed, time_limit);
    try {
      trial.run();
    } catch (const Fault& fault) {
      ++faults;
      const fs::path kept = keep / ("fuzz-" + std::to_string(seed));
      trial.keep(kept);
      std::printf("seed %llu: %s\n  %s\n  kept as %s\n", static_cast<unsigned long long>(seed),
                  fault.what.c_str(), trial.command().c_str(), kept.c_str());
      std::fflush(stdout);
    }
    refused += trial.refused();
    if (trial.slowest() > slowest) slowest = trial.slowest(), slowest_seed = seed;
  }
  std::printf("surfaces %llu\nrefused %llu\nfaults %llu\nseconds %.0f\n",
              static_cast<unsigned long long>(trials), static_cast<unsigned long long>(refused),
              static_cast<unsigned long long>(faults), elapsed());
  std::printf("slowest_run %.1f\nslowest_seed %llu\n", slowest,
              static_cast<unsigned long long>(slowest_seed));
  return faults == 0 ? tools::exit_done : 1;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fuzz", argc, argv, fuzz_tools); }
