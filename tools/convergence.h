#pragma once
// How fast samples become blue noise, and in what time: figures 10 and 11 of the paper.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "fpo/optimize.h"
#include "geom/mesh/trimesh.h"
#include "io/chart.h"

namespace tools {

/// A way from random samples to good ones (section 4.3).
struct Way {
  const char* name = "";
  const char* colour = "";
  bool shortest_edges = false;  ///< shortest edge removal first
  fpo::Scope scope = fpo::Scope::global;
};

inline constexpr std::array<Way, 4> ways = {{{"global", "#1d4f91", false, fpo::Scope::global},
                                             {"local", "#2a8a57", false, fpo::Scope::two_ring},
                                             {"SER + global", "#c0392b", true, fpo::Scope::global},
                                             {"SER + local", "#d98a00", true, fpo::Scope::two_ring}}};

/// The models whose convergence figure 10 shows, all uniform.
struct ConvergenceCase {
  const char* model;  ///< as the paper spells it
  std::size_t samples;
};
inline constexpr std::array<ConvergenceCase, 4> convergence_cases = {
    {{"Venus", 1700}, {"Eight", 1700}, {"Homer", 7900}, {"Bunny", 6300}}};

/// CPU seconds of the calling thread.
double thread_seconds();

/// By iteration, the state before the first one included.
struct Convergence {
  std::vector<double> delta, mean_delta;
  std::vector<double> microseconds;  ///< of CPU a sample, since `start`
  double removal_seconds = 0;        ///< of CPU, for shortest edge removal
  std::vector<double> measured;      ///< what ConvergenceOptions::measure said
};

struct ConvergenceOptions {
  int iterations = 100;
  fpo::VisitOrder order = fpo::VisitOrder::in_turn;
  double enough_mean_delta = std::numeric_limits<double>::infinity();  ///< stops there
  std::function<double()> measure = {};  ///< of the state; its time does not count
};

/// Takes the domain that way. `start`: thread_seconds() before the domain was made.
Convergence converge(fpo::Domain& domain, const Way& way, double start, const ConvergenceOptions& options);
/// The same from `samples` random samples on a surface, uniform.
Convergence converge(const geom::TriMesh& surface, std::size_t samples, std::uint64_t seed, const Way& way,
                     const ConvergenceOptions& options);

/// Term by term, of runs of equally many iterations.
Convergence mean(std::span<const Convergence> runs);

/// delta (thick) and its mean (thin) by iteration, one colour a way.
io::Chart convergence_chart(std::span<const Way> names, std::span<const Convergence> runs);
/// Microseconds a sample by iteration.
io::Chart runtime_chart(std::span<const Way> names, std::span<const Convergence> runs);

}  // namespace tools
