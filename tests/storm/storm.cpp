// storm: millions of calls of every exact predicate on adversarial draws, compared with exact integers, and
// how often each filter leaves the decision to exact arithmetic.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <numeric>
#include <vector>

#include "geom/parallel.h"
#include "tests/storm/trials.h"
#include "tools/cli.h"
#include "tools/interrupt.h"

namespace {

using storm::Kind;
using storm::Tally;

constexpr std::uint64_t chunk = 4000;    // calls
constexpr std::size_t most_faults = 20;  // more tell nothing new

/// The calls of all predicates on all kinds, cut into chunks with a seed each.
class Storm {
 public:
  Storm(std::uint64_t count, std::uint64_t seed, std::uint64_t rational_every)
      : count_(count),
        seed_(seed),
        rational_every_(rational_every),
        tallies_(storm::predicates().size() * Kind::all().size()) {}

  /// All kinds alike; what some of them cannot be asked, the others are asked instead.
  void run_predicate(std::size_t predicate, int threads) {
    std::vector<std::size_t> kinds(Kind::all().size());
    std::iota(kinds.begin(), kinds.end(), std::size_t{0});
    for (std::uint64_t done = 0, round = 0; done < count_ && round < 4; done = of(predicate).calls, ++round) {
      const std::uint64_t each = (count_ - done + kinds.size() - 1) / kinds.size();
      const std::uint64_t before = of(predicate, kinds.back()).calls;
      run_round(predicate, kinds, {each, round}, threads);
      if (tools::interrupt_flag()) return;
      std::erase_if(kinds, [&](std::size_t kind) { return of(predicate, kind).calls < before + each; });
      if (kinds.empty()) return;
    }
  }

  Tally of(std::size_t predicate, std::size_t kind) const {
    return tallies_[predicate * Kind::all().size() + kind];
  }
  Tally of(std::size_t predicate) const {
    Tally sum;
    for (std::size_t kind = 0; kind < Kind::all().size(); ++kind) sum += of(predicate, kind);
    return sum;
  }
  std::size_t faults() const { return faults_; }

 private:
  struct Round {
    std::uint64_t each, number;
  };

  void run_round(std::size_t predicate, const std::vector<std::size_t>& kinds, const Round& round,
                 int threads) {
    const std::size_t chunks = (round.each + chunk - 1) / chunk;
    geom::parallel_ranges(kinds.size() * chunks, 1, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && !tools::interrupt_flag(); ++i) {
        const std::size_t kind = kinds[i / chunks], number = i % chunks;
        const std::uint64_t seed =
            (((seed_ * 100 + predicate) * 100 + kind) * 10 + round.number) * 10'000'000 + number;
        run_chunk(predicate, kind, {std::min(chunk, round.each - number * chunk), seed, rational_every_});
      }
    });
  }

  void run_chunk(std::size_t predicate, std::size_t kind, const storm::Run& calls) {
    Tally tally;
    std::string fault;
    try {
      tally = run(storm::predicates()[predicate], Kind::all()[kind], calls);
    } catch (const storm::Fault& found) {
      fault = found.what;
    }
    const std::lock_guard lock(access_);
    tallies_[predicate * Kind::all().size() + kind] += tally;
    if (fault.empty() || ++faults_ > most_faults) return;
    std::printf("fault: %s: %s\n", Kind::all()[kind].name().c_str(), fault.c_str());
    std::fflush(stdout);
  }

  std::uint64_t count_, seed_, rational_every_;
  std::mutex access_;
  std::vector<Tally> tallies_;  ///< predicate by predicate, kind by kind
  std::size_t faults_ = 0;
};

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_kinds(const Storm& s) {
  std::printf("\nPercent of calls that the filter leaves to exact arithmetic:\n%-30s", "");
  for (const storm::Predicate& p : storm::predicates()) std::printf(" %15s", p.name);
  for (std::size_t kind = 0; kind < Kind::all().size(); ++kind) {
    std::printf("\n%-30s", Kind::all()[kind].name().c_str());
    for (std::size_t p = 0; p < storm::predicates().size(); ++p) {
      const Tally t = s.of(p, kind);
      std::printf(" %15.3f", percent(t.unsure, t.calls));
    }
  }
  std::printf("\n");
}

int brew(tools::CommandLine& cli) {
  std::uint64_t count = 10'000'000, rational_every = 2000;
  std::string only;
  cli.describe("", "Calls every exact predicate on adversarial draws and compares it with exact integers.");
  cli.integer({.name = "count", .value = "N", .help = "calls of each predicate"}, count, 1, UINT64_MAX);
  cli.integer({.name = "rational-every", .value = "N", .help = "compare one in N with the slow oracle too"},
              rational_every, 0, UINT64_MAX);
  cli.text({.name = "predicate", .value = "NAME", .help = "only this one", .standard = "all"}, only);
  cli.parse(0, 0);
  Storm storm(count, cli.seed(), rational_every);
  std::printf("%-16s %10s %9s %9s %8s\n", "predicate", "calls", "exact %", "tie %", "seconds");
  for (std::size_t p = 0; p < storm::predicates().size() && !tools::interrupt_flag(); ++p) {
    if (!only.empty() && only != storm::predicates()[p].name) continue;
    const auto start = std::chrono::steady_clock::now();
    storm.run_predicate(p, cli.threads());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Tally t = storm.of(p);
    std::printf("%-16s %10llu %9.3f %9.3f %8.1f\n", storm::predicates()[p].name,
                static_cast<unsigned long long>(t.calls), percent(t.unsure, t.calls),
                percent(t.ties, t.calls), seconds);
    std::fflush(stdout);
  }
  print_kinds(storm);
  std::printf("faults %zu\n", storm.faults());
  if (storm.faults() > 0) return 1;
  return tools::interrupt_flag() ? tools::exit_interrupted : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("storm", argc, argv, brew); }
