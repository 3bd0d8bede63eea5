#include "fpo/remesh/other_samples.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "fpo/remesh/attempts.h"
#include "fpo/remesh/return_to.h"
#include "fpo/remesh/unless_interrupted.h"
#include "fpo/surface/cut_edges.h"
#include "geom/check.h"

namespace fpo {
namespace {

constexpr std::uint64_t tries = 3;
constexpr std::size_t few_flaws = 12;
constexpr std::uint64_t far_seed = 0x9e3779b97f4a7c15;  // those near to the options' seed are for others

/// Those that other samples may not have.
std::size_t num_flaws(const RemeshResult& result) {
  if (!result.type.ok()) return std::max(result.advice.places.size(), result.thin_parts.faults_after);
  const std::size_t angles = result.measures.angles_below_30;
  return angles - std::min(angles, result.sharp_corners);
}

bool may_be_luck(const RemeshResult& result, const RemeshOptions& options) {
  const std::size_t flaws = num_flaws(result);
  return options.method == Method::fpo && options.mend && options.optimize_angles && !options.maximal &&
         result.kept && !result.by_collapses && !result.stood_in && result.least_length == 0 &&
         result.mesh.num_facets() > 0 && result.broken_feature_edges == 0 && flaws > 0 &&
         flaws <= few_flaws && !has_wanted_angles(as_it_will_be(result));
}

/// The same smallest angle, to the last bit, and as many: the seed does not matter to it, as where all three
/// corners are on curves.
bool has_same_angle(const RemeshResult& a, const RemeshResult& b) {
  return a.type.ok() && b.type.ok() && a.measures.theta_min == b.measures.theta_min &&
         a.measures.angles_below_30 == b.measures.angles_below_30;
}

/// As the result was made. None if that is interrupted, or refused.
std::optional<RemeshResult> remade(const geom::TriMesh& surface, const RemeshOptions& how,
                                   const RemeshResult& result, const RemeshWithFeatures& remesh) try {
  const FeatureChoice choice{*result.kept, result.given_up, result.features_missed, result.collapsed_curves};
  if (!result.cut) return remesh(surface, choice, how);
  RemeshOptions there = how;
  if (!there.rho.empty()) there.rho = on_cut_edges(surface, *result.cut, there.rho);
  std::optional<RemeshResult> other = remesh(result.cut->mesh, choice, there);
  if (other) return_to(surface, result.cut, *other);
  return other;
} catch (const geom::InputError&) {
  return {};
}

}  // namespace

RemeshResult with_other_samples(const geom::TriMesh& surface, const RemeshOptions& options,
                                RemeshResult result, const RemeshWithFeatures& remesh) {
  RemeshOptions how = in_the_way_of(result, options);
  for (std::uint64_t k = 1; k <= tries && may_be_luck(result, options) && !interrupted(options); ++k) {
    how.seed = options.seed + k * far_seed;
    std::optional<RemeshResult> other = remade(surface, how, result, remesh);
    if (other && has_same_angle(*other, result)) break;
    if (other && is_better(as_it_will_be(*other), as_it_will_be(result))) result = std::move(*other);
  }
  return result;
}

}  // namespace fpo
