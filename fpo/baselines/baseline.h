#pragma once
// What the other methods of the paper's table 1 have in common here: each turns a surface, a sizing and a
// number of samples into samples. Meshes are made of them as of those of farthest point optimization
// (pipeline.h).

#include <cstdint>
#include <span>
#include <vector>

#include "fpo/interruption.h"
#include "fpo/optimize.h"
#include "fpo/surface/sizing.h"
#include "fpo/surface/spacings.h"
#include "fpo/surface/surface_sample.h"

namespace fpo {

/// What is to be sampled. All references must outlive the call.
struct BaselineTask {
  const geom::TriMesh& surface;
  const Sizing& sizing;
  std::span<const SurfaceSample> fixed;  ///< samples that are there already and stay: the first of the result
  std::size_t num_samples;               ///< wanted in all; at least those that are fixed
  std::uint64_t seed = 1;
  int threads = 1;  ///< no matter to the result
  /// Of Poisson disks, in units of h: if given, it is taken, and the number of samples is what comes of it.
  double radius_factor = 0;

  std::size_t num_inner() const { return num_samples - fixed.size(); }
};

/// What a method has reached of what it aims at, by name: for output.
struct Reached {
  const char* name;
  double value;
};

struct BaselineResult {
  std::vector<SurfaceSample> samples;  ///< their positions in the exact range (geom/mesh/scaling.h)
  double radius_factor = 0;            ///< of Poisson disks: a sample's disk has this radius times h there
  OptimizeResult run;                  ///< iterations, or radii tried
  std::vector<Reached> reached;        ///< the method's own measures
};

/// delta and mean delta (spacings.h).
inline IterationReport measure(const BaselineTask& task, std::span<const SurfaceSample> samples) {
  return measure_positions(samples, task.sizing, task.fixed.size(), task.threads);
}

/// Whether somebody wants the end.
inline bool interrupted(const OptimizeOptions& options) { return interrupted(options.interrupted); }

}  // namespace fpo
