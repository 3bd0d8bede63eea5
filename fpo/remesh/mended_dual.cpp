#include "fpo/remesh/mended_dual.h"

#include "fpo/interruption.h"

namespace fpo {
namespace {

constexpr int futile_mending_rounds = 10;  // in a row, without fewer defects

}  // namespace

Dual mended_dual(SurfaceDomain& domain, const FeatureSamples& features, const geom::SurfaceType& type,
                 const RemeshOptions& options, RemeshResult& counts) {
  const auto next_dual = [&] {
    if (options.mend) counts.protection += protect_chains(domain, features);
    return dual_of(domain, type, options.keep_cells);
  };
  Dual best = next_dual();
  std::vector<Defect> defects = best.defects;
  for (int futile = 0; futile < futile_mending_rounds && options.mend && !defects.empty() &&
                       !interrupted(options.optimize.interrupted);
       ++futile) {
    const std::size_t moved = refine_at(domain, defects);
    if (moved == 0) break;
    counts.brought += moved;
    Dual next = next_dual();
    defects = next.defects;
    if (next.num_faults() >= best.num_faults()) continue;
    best = std::move(next);
    futile = 0;
  }
  if (counts.brought == 0 || !best.type.ok() || !options.optimize_angles) return best;
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  optimize_angles(domain, angles);  // around the samples brought
  Dual better = next_dual();
  return better.type.ok() ? better : best;
}

}  // namespace fpo
