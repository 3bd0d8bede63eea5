#pragma once
// How a surface is remeshed unless something else is asked for: by fpo-remesh and by the library (fpo.h)
// alike.

#include <optional>

#include "fpo/remesh/methods.h"
#include "fpo/remesh/pipeline.h"

namespace fpo {

/// With uniform sizing the whole surface is searched for farthest points, which gives the best angles; else
/// the neighbourhood, for samples that travel far change the density.
inline Scope default_scope(SizingKind sizing) {
  return sizing == SizingKind::uniform ? Scope::global : Scope::two_ring;
}

inline int default_iterations(Method method, SizingKind sizing) {
  const MethodFacts& facts = facts_of(method);
  return sizing == SizingKind::uniform ? facts.iterations : facts.adaptive_iterations;
}

/// Samples a tile if there are so many that tiles pay; 0: none. With rest a round has less to do.
inline std::size_t default_tile_samples(std::size_t num_samples, bool rest = false) {
  constexpr std::size_t most = 3000;
  const std::size_t least_tiles = rest ? 10 : 2;
  return num_samples > least_tiles * most ? most : 0;
}

/// The other methods are compared as they are: the improvements that follow ours are for that one.
inline void use_method(RemeshOptions& options, Method method) {
  options.method = method;
  options.optimize_angles = options.improve_fidelity = method == Method::fpo;
  options.optimize.max_iterations = default_iterations(method, options.sizing);
}

/// What has no default of its own: left out, it follows from method, sizing and number of samples.
struct Choices {
  std::optional<Scope> scope{};               ///< of the search for farthest points
  std::optional<double> weight_factor{};      ///< a sample's weight is (this times the wanted length)^2
  std::optional<int> iterations{};            ///< at most
  std::optional<std::size_t> tile_samples{};  ///< at most, in a tile; 0: no tiles
  std::optional<bool> optimize_angles{}, improve_fidelity{};
  std::optional<bool> come_closer{};  ///< left out: where that is cheap, unless another target is set
  bool rest = false;                  ///< do not move samples where the target is met already (rest.h)
};

/// Completes options of which the method, the sizing, the number of samples and the goal are set. Throws
/// geom::InputError on a choice that the method does not know.
inline void complete(RemeshOptions& options, const Choices& choices) {
  geom::require(
      options.method == Method::fpo || !(options.shortest_edge_removal || choices.scope || choices.rest),
      "shortest edge removal, a scope and rest are of farthest point optimization only");
  OptimizeOptions& optimize = options.optimize;
  optimize.scope = choices.scope.value_or(default_scope(options.sizing));
  options.surface.weight_factor = choices.weight_factor.value_or(best_weight_factor(optimize.scope));
  if (choices.rest) optimize.rest_spacing = optimize.target_delta + rest_margin;
  use_method(options, options.method);
  if (choices.optimize_angles) options.optimize_angles = *choices.optimize_angles;
  if (choices.improve_fidelity) options.improve_fidelity = *choices.improve_fidelity;
  if (choices.come_closer)
    options.closer = *choices.come_closer ? Closer::always : Closer::never;
  else if (optimize.target_delta == OptimizeOptions().target_delta)
    options.closer = Closer::automatic;
  if (choices.iterations) optimize.max_iterations = *choices.iterations;
  options.tile_samples =
      choices.tile_samples.value_or(default_tile_samples(options.num_samples, choices.rest));
}

/// All of it for that many samples, without tiles.
inline RemeshOptions default_options(std::size_t num_samples, SizingKind sizing) {
  RemeshOptions options;
  options.num_samples = num_samples;
  options.sizing = sizing;
  options.features = automatic_features();
  complete(options, {.tile_samples = 0});
  return options;
}

}  // namespace fpo
