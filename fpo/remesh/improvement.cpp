#include "fpo/remesh/improvement.h"

#include <algorithm>
#include <utility>

#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/emptied_balls.h"
#include "fpo/remesh/mended_dual.h"
#include "fpo/remesh/remembered_samples.h"

namespace fpo {
namespace {

constexpr std::size_t least_fidelity_moves = 2000;
constexpr std::size_t moves_to_come_closer = 20;  // a sample, if it is asked for
constexpr double most_far = 1.0 / 12;             // of the triangles, if it is not
constexpr std::size_t looks_a_move = 20;          // of the optimization, then: about a quarter of its time

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

FidelityOptions fidelity_options(const Improvement& how, const RemeshOptions& options,
                                 const RemeshResult& result) {
  FidelityOptions fidelity;
  fidelity.enough_delta = options.angles.enough_delta;
  fidelity.interrupted = options.optimize.interrupted;
  const bool has_features = !how.shared.features.samples.empty();
  if (options.method == Method::fpo)  // who wants it fast wants this fast, too
    fidelity.most_moves = least_fidelity_moves + result.optimization.moves / (has_features ? 4 : 12);
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
  closeness.most_moves = by_itself ? least_fidelity_moves + result.optimization.moves / 12
                                   : least_fidelity_moves + moves_to_come_closer * domain.num_samples();
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
  const FidelityOptions fidelity = fidelity_options(how, options, result);
  if (!by_itself) result.fidelity = improve_fidelity(domain, how.angles, fidelity);
  if (by_itself || options.closer == Closer::always)
    result.closeness =
        come_closer(domain, how.angles, closeness_options(domain, options, by_itself, before, result));
  if (by_itself && result.closeness.tried == 0)
    result.fidelity = improve_fidelity(domain, how.angles, fidelity);
}

/// What follows the optimization: angles, fidelity, closeness; edges of curves are proven before and after.
/// `before`: its samples.
void improve(SurfaceDomain& domain, const Improvement& how, const RemeshOptions& options,
             const RememberedSamples& before, RemeshResult& result) {
  prove_edges(domain, how, options);
  if (options.optimize_angles && !is_stopped(options)) result.angles = optimize_angles(domain, how.angles);
  if (options.improve_fidelity && !result.stood_in && !is_stopped(options))
    come_nearer(domain, how, options, before, result);
  prove_edges(domain, how, options);
}

}  // namespace

AngleOptions angle_options(const RemeshOptions& options) {
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  return angles;
}

Dual improved_dual(SurfaceDomain& domain, const Improvement& how, RemeshOptions options,
                   RemeshResult& result) {
  const FeatureSamples& features = how.shared.features;
  const RememberedSamples before(domain);
  const bool mends_first = !options.maximal && is_past_mending(result.thin_parts, domain.num_samples());
  if (!mends_first) improve(domain, how, options, before, result);
  if (options.maximal)
    result.maximal =
        make_maximal(domain, {features.samples.size(), options.threads, options.optimize.interrupted});
  result.hidden = domain.num_hidden();
  Dual dual = mended_dual(domain, features, how.type, options, result);
  if (mends_first && dual.type.ok()) {
    const RememberedSamples mended(domain);
    improve(domain, how, options, before, result);
    Dual better = mended_dual(domain, features, how.type, options, result);
    if (better.type.ok())
      dual = std::move(better);
    else
      mended.put_back(domain);
  }
  for (bool* step : {&options.improve_fidelity, &options.optimize_angles}) {
    if (dual.type.ok() || !result.thin_parts.right_type || options.maximal || is_stopped(options))
      return dual;
    if (!std::exchange(*step, false)) continue;
    before.put_back(domain);
    result.angles = {};
    result.fidelity = {};
    result.closeness = {};
    result.brought = 0;
    improve(domain, how, options, before, result);
    result.hidden = domain.num_hidden();
    dual = mended_dual(domain, features, how.type, options, result);
  }
  return dual;
}

}  // namespace fpo
