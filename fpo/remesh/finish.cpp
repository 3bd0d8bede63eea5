#include "fpo/remesh/finish.h"

#include <tuple>
#include <utility>

#include "fpo/remesh/recovered_edges.h"

namespace fpo {

Finish finish(SurfaceDomain& domain, const FeatureSamples& features, const geom::SurfaceType& type,
              const FinishOptions& options, Dual& dual) {
  Finish result;
  std::tie(dual.mesh, result.recovered_edges) = recover_edges(dual.mesh, features);
  if (!options.mend_angles || !dual.type.is_manifold()) return result;
  const bool right_type = dual.type.ok();
  const auto before = std::pair(dual.mesh, dual.samples);
  result.last_angles = mend_last_angles(
      {domain.mesh(), domain.sizing(), features, options.slides, options.angles}, dual.mesh, dual.samples);
  if (result.last_angles.mended == 0) return result;
  dual.type = check_type(type, dual.mesh, dual.samples);
  if (right_type && !dual.type.ok()) {  // angles are not worth that
    std::tie(dual.mesh, dual.samples) = before;
    dual.type = check_type(type, dual.mesh, dual.samples);
    result.last_angles = {};
    return result;
  }
  if (!options.keep_cells) return result;
  for (std::size_t i = 0; i < dual.samples.size(); ++i) {
    const SiteId x(i);
    if (domain.sample(x).position == dual.samples[i].position) continue;
    const double share = domain.weight_share(x);
    domain.remove(x);
    domain.insert_at(x, dual.samples[i], share);
  }
  dual.cells = cell_polygons(*domain.diagram());
  return result;
}

}  // namespace fpo
