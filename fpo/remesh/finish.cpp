#include "fpo/remesh/finish.h"

#include <span>
#include <tuple>
#include <utility>

#include "fpo/remesh/recovered_edges.h"

namespace fpo {

namespace {

/// On the mesh. What is done for 30 degrees does not ask for delta.
void mend_angles(const LastAnglesTask& task, const FinishOptions& options, Dual& dual, Finish& result) {
  LastAnglesTask with_delta = task;
  const double least_edge = task.sizing.is_even() ? options.least_edge : task.goal.least_edge;
  with_delta.goal = {task.angles.smallest, least_edge, least_edge};
  if (options.all_wanted)
    result.mended_with_delta = mend_last_angles(with_delta, dual.mesh, dual.samples).mended;
  result.last_angles = mend_last_angles(task, dual.mesh, dual.samples);
}

/// Those that moved.
void put_samples(SurfaceDomain& domain, std::span<const SurfaceSample> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SiteId x(i);
    if (domain.sample(x).position == samples[i].position) continue;
    const double share = domain.weight_share(x);
    domain.remove(x);
    domain.insert_at(x, samples[i], share);
  }
}

}  // namespace

Finish finish(std::unique_ptr<SurfaceDomain> domain, const FeatureSamples& features, const WantedType& type,
              const FinishOptions& options, Dual& dual) {
  const geom::TriMesh& surface = domain->mesh();
  const Sizing sizing = domain->sizing();
  if (!options.keep_cells) domain.reset();
  Finish result;
  std::tie(dual.mesh, result.recovered_edges) = recover_edges(dual.mesh, features);
  if (!options.mend_angles || !dual.type.is_manifold()) return result;
  const bool right_type = dual.type.ok();
  const auto before = std::pair(dual.mesh, dual.samples);
  mend_angles({surface, sizing, features, options.slides, options.angles}, options, dual, result);
  if (result.last_angles.mended + result.mended_with_delta == 0) return result;
  dual.type = check_type(type, dual.mesh, dual.samples);
  if (right_type && !dual.type.ok()) {  // angles are not worth that
    std::tie(dual.mesh, dual.samples) = before;
    dual.type = check_type(type, dual.mesh, dual.samples);
    result.last_angles = {};
    result.mended_with_delta = 0;
    return result;
  }
  if (!options.keep_cells) return result;
  put_samples(*domain, dual.samples);
  dual.cells = cell_polygons(*domain->diagram());
  return result;
}

}  // namespace fpo
