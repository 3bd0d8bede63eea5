#pragma once
// How fpo-remesh remeshes unless it is told otherwise.

#include "fpo/pipeline.h"

namespace tools {

/// With uniform sizing the whole surface is searched for farthest points, which gives the best angles; else
/// the neighbourhood, for samples that travel far change the density.
inline fpo::Scope default_scope(fpo::SizingKind sizing) {
  return sizing == fpo::SizingKind::uniform ? fpo::Scope::global : fpo::Scope::two_ring;
}

inline int default_iterations(fpo::Method method, fpo::SizingKind sizing) {
  const fpo::MethodFacts& facts = fpo::facts_of(method);
  return sizing == fpo::SizingKind::uniform ? facts.iterations : facts.adaptive_iterations;
}

/// Samples a tile if there are so many that tiles pay; 0: none. With rest a round has less to do.
inline std::size_t default_tile_samples(std::size_t num_samples, bool rest = false) {
  constexpr std::size_t most = 3000;
  const std::size_t least_tiles = rest ? 10 : 2;
  return num_samples > least_tiles * most ? most : 0;
}

/// The other methods are compared as they are: the improvements that follow ours are for that one.
inline void use_method(fpo::RemeshOptions& options, fpo::Method method) {
  options.method = method;
  options.optimize_angles = options.improve_fidelity = method == fpo::Method::fpo;
  options.optimize.max_iterations = default_iterations(method, options.sizing);
}

/// All of it for that many samples.
inline fpo::RemeshOptions default_options(std::size_t num_samples, fpo::SizingKind sizing) {
  fpo::RemeshOptions options;
  options.num_samples = num_samples;
  options.sizing = sizing;
  options.features = fpo::automatic_features();
  options.optimize.scope = default_scope(sizing);
  use_method(options, fpo::Method::fpo);
  options.surface.weight_factor = fpo::best_weight_factor(options.optimize.scope);
  return options;
}

}  // namespace tools
