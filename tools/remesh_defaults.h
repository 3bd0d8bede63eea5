#pragma once
// How fpo-remesh remeshes unless it is told otherwise.

#include "fpo/pipeline.h"

namespace tools {

/// With uniform sizing the whole surface is searched for farthest points, which gives the best angles; else the
/// neighbourhood, for samples that travel far change the density.
inline fpo::Scope default_scope(fpo::SizingKind sizing) {
  return sizing == fpo::SizingKind::uniform ? fpo::Scope::global : fpo::Scope::two_ring;
}

/// By measurement (bench-adaptive) local iterations past 40 change nothing.
inline int default_iterations(fpo::SizingKind sizing) {
  return sizing == fpo::SizingKind::uniform ? 100 : 40;
}

/// All of it for that many samples.
inline fpo::RemeshOptions default_options(std::size_t num_samples, fpo::SizingKind sizing) {
  fpo::RemeshOptions options;
  options.num_samples = num_samples;
  options.sizing = sizing;
  options.features = fpo::automatic_features();
  options.optimize.scope = default_scope(sizing);
  options.optimize.max_iterations = default_iterations(sizing);
  options.surface.weight_factor = fpo::best_weight_factor(options.optimize.scope);
  return options;
}

}  // namespace tools
