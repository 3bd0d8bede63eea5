#include "fpo/remesh/mended_dual.h"

#include <optional>

#include "fpo/interruption.h"
#include "fpo/remesh/remembered_samples.h"
#include "fpo/remesh/sent_away.h"

namespace fpo {
namespace {

constexpr int futile_mending_rounds = 10;  // in a row, without a tenth fewer faults
constexpr int futile_rounds_in_ruins = 2;  // where more than a tenth of the samples are at fault
constexpr std::size_t samples_for_one_fault = 10;

int most_futile_rounds(const Dual& dual) {
  const bool in_ruins = dual.num_faults() * samples_for_one_fault > dual.samples.size();
  return in_ruins ? futile_rounds_in_ruins : futile_mending_rounds;
}

/// So that it goes on: a bound of the rounds by the logarithm of the faults.
std::size_t few_enough(const Dual& dual) {
  const std::size_t faults = dual.num_faults();
  return faults == 0 ? 0 : faults - 1 - (faults - 1) / 10;
}

}  // namespace

Dual mended_dual(SurfaceDomain& domain, const FeatureSamples& features, const WantedType& type,
                 const RemeshOptions& options, RemeshResult& counts) {
  const auto next_dual = [&] {
    if (options.mend) counts.protection += protect_chains(domain, features, options.optimize.interrupted);
    return dual_of(domain, type, options.keep_cells, options.optimize.interrupted);
  };
  Dual best = next_dual();
  std::optional<RememberedSamples> of_best;  // if there is anything to mend
  if (options.mend && !best.type.ok()) of_best.emplace(domain);
  std::vector<Defect> defects = best.defects;
  std::size_t most = few_enough(best);
  for (int futile = 0; futile < most_futile_rounds(best) && options.mend && !defects.empty() &&
                       !interrupted(options.optimize.interrupted);
       ++futile) {
    const std::size_t moved = refine_at(domain, defects);
    if (moved == 0) break;
    counts.brought += moved;
    Dual next = next_dual();
    defects = next.defects;
    if (next.num_faults() >= best.num_faults()) continue;
    best = std::move(next);
    if (!best.type.ok()) of_best.emplace(domain);
    if (best.num_faults() > most) continue;
    futile = 0;
    most = few_enough(best);
  }
  if (of_best && !best.type.ok()) {
    of_best->put_back(domain);
    counts.brought += nudge_aside(domain, next_dual, options.optimize.interrupted, best);
    counts.brought += send_away(domain, next_dual, options.optimize.interrupted, best);
  }
  if (counts.brought == 0 || !best.type.ok() || !options.optimize_angles) return best;
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  const RememberedSamples mended(domain);
  optimize_angles(domain, angles);  // around the samples brought
  Dual better = next_dual();
  if (better.type.ok()) return better;
  mended.put_back(domain);
  return best;
}

}  // namespace fpo
