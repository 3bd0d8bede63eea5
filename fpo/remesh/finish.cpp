#include "fpo/remesh/finish.h"

#include <tuple>

#include "fpo/remesh/recovered_edges.h"

namespace fpo {

Finish finish(SurfaceDomain& domain, const FeatureSamples& features, const FinishOptions& options,
              Dual& dual) {
  Finish result;
  std::tie(dual.mesh, result.recovered_edges) = recover_edges(dual.mesh, features);
  if (!options.mend_angles || !dual.type.is_manifold()) return result;
  const std::vector<SurfaceSample> before = dual.samples;
  result.last_angles = mend_last_angles(
      {domain.mesh(), domain.sizing(), features, options.slides, options.angles}, dual.mesh, dual.samples);
  if (!options.keep_cells || result.last_angles.mended == 0) return result;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const SiteId x(i);
    if (before[i].position == dual.samples[i].position) continue;
    const double share = domain.weight_share(x);
    domain.remove(x);
    domain.insert_at(x, dual.samples[i], share);
  }
  dual.cells = cell_polygons(*domain.diagram());
  return result;
}

}  // namespace fpo
