#include "fpo/remesh/improvement.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/emptied_balls.h"
#include "fpo/remesh/mended_dual.h"
#include "fpo/remesh/protect.h"
#include "fpo/remesh/remembered_samples.h"
#include "fpo/remesh/taken_back.h"

namespace fpo {
namespace {

constexpr std::size_t least_moves_closer = 2000;
constexpr std::size_t most_facets = 1'000'000;    // of the surface that these moves pass
constexpr std::size_t moves_to_come_closer = 20;  // a sample, if it is asked for
constexpr double most_far = 1.0 / 12;             // of the triangles, if it is not
constexpr std::size_t looks_a_move = 20;          // of the optimization, then: at most about its time

bool is_stopped(const RemeshOptions& options) { return interrupted(options.optimize.interrupted); }

void prove_edges(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options) {
  if (!how.curves || is_stopped(options)) return;
  empty_balls(domain, *how.curves, how.shared.features);
  send_out_of_balls(domain, *how.curves, how.shared.features, options.optimize.interrupted);
}

/// Where lengths are even and neither features nor thin parts are in the way.
bool comes_closer_by_itself(const SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
                            const RemeshResult& result) {
  return options.closer == Closer::automatic && options.method == Method::fpo &&
         domain.sizing().is_uniform() && how.shared.features.samples.empty() && !domain.mesh().has_levels() &&
         result.thin_parts.faults_before == 0;
}

/// How many there may be, few as the samples are. A move passes the facets of a cell, at least: there are
/// fewer where these are thousands.
std::size_t least_fidelity_moves(const SurfaceDomain& domain) {
  return std::min(least_moves_closer, most_facets / (domain.mesh().num_facets() / domain.num_samples() + 1));
}

FidelityOptions fidelity_options(const SurfaceDomain& domain, const Improvement& how,
                                 const RemeshOptions& options, const RemeshResult& result) {
  FidelityOptions fidelity;
  fidelity.enough_delta = options.angles.enough_delta;
  fidelity.interrupted = options.optimize.interrupted;
  const bool has_features = !how.shared.features.samples.empty();
  if (options.method == Method::fpo)  // who wants it fast wants this fast, too
    fidelity.most_moves = least_fidelity_moves(domain) + result.optimization.moves / (has_features ? 4 : 12);
  if (result.thin_parts.faults_before > 0) {  // moves there cost the most and bring samples together
    fidelity.most_moves /= 4;
    fidelity.keep_spacing = true;
  }
  if (has_features) {  // fixed samples keep delta from more, and shape matters more
    fidelity.share_of_largest = 0.5;
    fidelity.enough_delta = std::min(0.9, fidelity.enough_delta);
  }
  return fidelity;
}

/// `by_itself`: nobody has asked for it.
ClosenessOptions closeness_options(const SurfaceDomain& domain, const RemeshOptions& options, bool by_itself,
                                   const RememberedSamples& before, const RemeshResult& result) {
  ClosenessOptions closeness;
  closeness.enough_delta = std::min(options.closer_delta, options.angles.enough_delta);
  closeness.most_moves = by_itself
                             ? least_fidelity_moves(domain) + result.optimization.moves / 12
                             : least_fidelity_moves(domain) + moves_to_come_closer * domain.num_samples();
  if (by_itself)
    closeness.most_far = most_far, closeness.most_looks = looks_a_move * result.optimization.moves;
  closeness.older = &before;
  closeness.threads = options.threads;
  closeness.interrupted = options.optimize.interrupted;
  return closeness;
}

/// Fidelity looks from the remesh to the surface, closeness both ways: where it does its work by itself,
/// nothing is left to fidelity.
void come_nearer(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
                 const RememberedSamples& before, RemeshResult& result) {
  const bool by_itself = comes_closer_by_itself(domain, how, options, result);
  const FidelityOptions fidelity = fidelity_options(domain, how, options, result);
  if (!by_itself) result.fidelity = improve_fidelity(domain, how.angles, fidelity);
  if (by_itself || options.closer == Closer::always)
    result.closeness =
        come_closer(domain, how.angles, closeness_options(domain, options, by_itself, before, result));
  if (by_itself && result.closeness.mended == 0)
    result.fidelity = improve_fidelity(domain, how.angles, fidelity);
}

/// What follows the optimization: angles, fidelity, closeness; edges of curves are proven before and after.
/// `before`: its samples. Returns those with better angles alone.
RememberedSamples improve(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
                          const RememberedSamples& before, RemeshResult& result) {
  prove_edges(domain, how, options);
  if (options.optimize_angles && !is_stopped(options)) result.angles = optimize_angles(domain, how.angles);
  RememberedSamples angled(domain, &before);
  if (options.improve_fidelity && !result.stood_in && !is_stopped(options))
    come_nearer(domain, how, options, before, result);
  prove_edges(domain, how, options);
  return angled;
}

/// Takes back what improve() did for other things than angles, as if it had not been asked for.
void keep_angles(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
                 const RememberedSamples& angled, RemeshResult& result) {
  angled.put_back(domain);
  result.fidelity = {};
  result.closeness = {};
  prove_edges(domain, how, options);
}

/// If it was right before: the dual, when what made it wrong is taken back (taken_back.h). None if that is no
/// help: then the samples are as they were improved.
std::optional<Dual> restored_dual(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
                                  const RememberedSamples& before, RemeshResult& result) {
  if (!result.thin_parts.right_type || !options.mend || options.maximal) return {};
  const std::atomic<bool>* interrupted = options.optimize.interrupted;
  const auto next_dual = [&] {
    result.protection += protect_chains(domain, how.shared.features, interrupted);
    return dual_of(domain, how.type, options.keep_cells, interrupted);
  };
  result.hidden = domain.num_hidden();
  Dual dual = next_dual();
  if (is_right(dual)) return dual;
  const Protection protection = result.protection;
  const RememberedSamples improved(domain, &before);
  if (take_back(domain, before, next_dual, interrupted, dual)) return dual;
  improved.put_back(domain);
  result.protection = protection;
  return {};
}

/// Where there is much to mend, that comes first.
Dual improved_when_mended(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
                          RemeshResult& result) {
  const auto mended = [&](bool optimize_angles) {
    RemeshOptions mending = options;
    mending.optimize_angles &= optimize_angles;
    return mended_dual(domain, how.shared.features, how.type, mending, result);
  };
  result.hidden = domain.num_hidden();
  Dual dual = mended(false);  // angles are looked at below
  if (!dual.type.ok()) return dual;
  const std::size_t brought = result.brought;
  const RememberedSamples before(domain);
  const RememberedSamples angled = improve(domain, how, options, before, result);
  Dual better = mended(true);
  if (better.type.ok()) return better;
  if (options.improve_fidelity) {
    keep_angles(domain, how, options, angled, result);
    result.brought = brought;
    better = mended(true);
    if (better.type.ok()) return better;
  }
  before.put_back(domain);
  result.angles = {};
  result.brought = brought;
  return dual;
}

}  // namespace

AngleOptions angle_options(const RemeshOptions& options) {
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  return angles;
}

Dual improved_dual(SurfaceDomain& domain, const Improvement& how, RemeshOptions options,
                   RemeshResult& result) {
  if (!options.maximal && is_past_mending(result.thin_parts, domain.num_samples()))
    return improved_when_mended(domain, how, options, result);
  const FeatureSamples& features = how.shared.features;
  const RememberedSamples before(domain);
  const RememberedSamples angled = improve(domain, how, options, before, result);
  if (options.maximal)
    result.maximal =
        make_maximal(domain, {features.samples.size(), options.threads, options.optimize.interrupted});
  domain.shrink();  // memory is at its most now
  if (std::optional<Dual> right = restored_dual(domain, how, options, before, result))
    return std::move(*right);
  const auto looked_at = [&] {
    result.hidden = domain.num_hidden();
    return mended_dual(domain, features, how.type, options, result);
  };
  Dual dual = looked_at();
  const auto is_enough = [&] {
    return dual.type.ok() || !result.thin_parts.right_type || options.maximal || is_stopped(options);
  };
  if (!is_enough() && std::exchange(options.improve_fidelity, false)) {
    keep_angles(domain, how, options, angled, result);
    result.brought = 0;
    dual = looked_at();
  }
  if (!is_enough() && std::exchange(options.optimize_angles, false)) {
    before.put_back(domain);
    result.angles = {};
    result.brought = 0;
    improve(domain, how, options, before, result);
    dual = looked_at();
  }
  return dual;
}

}  // namespace fpo
