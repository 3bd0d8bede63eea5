// endurance: a million moves on each of several domains, verified all along. A failing run is minimised and
// saved as a replay, which tests/endurance/replay_test.cpp runs for ever after.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>

#include "geom/parallel.h"
#include "io/atomic_file.h"
#include "tests/endurance/run.h"
#include "tools/cli.h"
#include "tools/interrupt.h"

namespace {

using endurance::Course;
using endurance::RunResult;

struct Arguments {
  endurance::RunOptions run;
  std::string course;
  std::filesystem::path keep = ".", replay;
  std::uint64_t trials = 5000;
};

Arguments parse(tools::CommandLine& cli) {
  Arguments a;
  cli.describe("", "Moves samples on surfaces and on tori for long, verifying all structures.");
  cli.integer({.name = "moves", .value = "N", .help = "on each domain"}, a.run.moves, 1, UINT64_MAX);
  cli.integer({.name = "check-every", .value = "N", .help = "moves between checks of all invariants"},
              a.run.check_every, 1, UINT64_MAX);
  cli.integer({.name = "brute-every", .value = "N", .help = "moves between samples by brute force"},
              a.run.brute_every, 1, UINT64_MAX);
  cli.integer({.name = "rebuild-every", .value = "N", .help = "moves between comparisons with a rebuild"},
              a.run.rebuild_every, 1, UINT64_MAX);
  cli.text({.name = "course", .value = "NAME", .help = "only this domain", .standard = "all"}, a.course);
  cli.path({.name = "keep", .value = "FOLDER", .help = "where replays of faults are saved"}, a.keep);
  cli.path({.name = "replay", .value = "FILE", .help = "runs this instead, verifying after each operation"},
           a.replay);
  cli.integer({.name = "trials", .value = "N", .help = "at most, to minimise a fault"}, a.trials, 0,
              UINT64_MAX);
  cli.parse(0, 0);
  a.run.seed = cli.seed();
  a.run.interrupted = [] { return tools::interrupt_flag().load(); };
  return a;
}

void report(const Course& course, const RunResult& r, double seconds) {
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf("%-15s %9llu moves %9llu operations %6llu checks %6llu brute %5llu rebuilds %7.1f s  %s\n",
              course.name.c_str(), number(r.moves), number(r.operations), number(r.checks),
              number(r.brute_force_checks), number(r.rebuilds), seconds,
              r.failure ? r.failure->remark.c_str() : "no fault");
  std::fflush(stdout);
}

void save(const Arguments& a, const Course& course, const RunResult& r) {
  const endurance::Replay small = endurance::minimised(*r.failure, a.trials);
  const std::filesystem::path path =
      a.keep / (course.name + "-" + std::to_string(a.run.seed) + "-" + std::to_string(r.moves) + ".txt");
  io::write_file(path, to_text(small));
  std::printf("%-15s minimised from %zu to %zu operations: %s\n", course.name.c_str(),
              r.failure->operations.size(), small.operations.size(), path.c_str());
  std::fflush(stdout);
}

int endure(tools::CommandLine& cli) {
  const Arguments a = parse(cli);
  if (!a.replay.empty()) {
    const std::string fault = fault_of(endurance::read_replay(a.replay), true);
    std::printf("%s: %s\n", a.replay.c_str(), fault.empty() ? "no fault" : fault.c_str());
    return fault.empty() ? tools::exit_done : 1;
  }
  std::vector<Course> courses = endurance::courses();
  if (!a.course.empty()) std::erase_if(courses, [&](const Course& c) { return c.name != a.course; });
  geom::require(!courses.empty(), "there is no domain '" + a.course + "'");
  std::mutex access;
  std::size_t faults = 0;
  geom::parallel_ranges(courses.size(), 1, cli.threads(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto start = std::chrono::steady_clock::now();
      const RunResult result = run(courses[i], a.run);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      const std::lock_guard lock(access);
      report(courses[i], result, seconds);
      if (!result.failure) continue;
      ++faults;
      save(a, courses[i], result);
    }
  });
  std::printf("faults %zu\n", faults);
  if (faults > 0) return 1;
  return tools::interrupt_flag() ? tools::exit_interrupted : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("endurance", argc, argv, endure); }
