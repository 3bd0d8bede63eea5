#include "fpo/remesh/stand_in_remesh.h"

#include <utility>

#include "fpo/interruption.h"
#include "fpo/remesh/last_angles.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/stand_in.h"
#include "geom/check.h"

namespace fpo {

std::optional<RemeshResult> remesh_of_stand_in(const geom::TriMesh& surface, const RemeshOptions& options,
                                               const RemeshFunction& remesh) try {
  const double spacing = even_spacing(surface, options);
  if (options.method != Method::fpo || options.optimize.max_iterations == 0) return {};
  if (!has_needles(surface, options.num_samples, spacing)) return {};
  const geom::TriMesh coarse = stand_in(surface, spacing);
  if (has_needles(coarse, options.num_samples, spacing)) return {};
  RemeshOptions there = options;
  there.fixed.clear();
  there.keep_cells = false;
  if (options.features && !options.features->marked.empty()) return {};
  RemeshResult result = remesh(coarse, there);
  result.samples = brought_to(surface, std::move(result.samples));
  result.stood_in = true;
  return result;
} catch (const geom::InputError&) {  // what can be done on the coarser surface only is not asked for
  return {};
}

RemeshResult with_mesh_on(const geom::TriMesh& surface, RemeshResult remesh, const RemeshOptions& options) {
  remesh.mesh = with_vertices_at(remesh.samples, remesh.mesh);
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  FeatureSamples features;
  features.samples.assign(remesh.samples.begin(),
                          remesh.samples.begin() + static_cast<std::ptrdiff_t>(remesh.feature_samples));
  if (options.mend && options.optimize_angles && remesh.type.is_manifold() &&
      !interrupted(angles.interrupted))
    remesh.finish.last_angles = mend_last_angles(
        {surface, Sizing(surface, remesh.sizing), features, nullptr, angles}, remesh.mesh, remesh.samples);
  remesh.fit = sizing_fit(remesh.mesh, remesh.wanted);
  remesh.measures = final_measures(remesh.mesh, remesh.wanted, remesh.feature_samples, angles);
  remesh.angles.bad_after = remesh.measures.bad_triangles;
  if (options.keep_cells)
    remesh.cells = cells_of(surface, Sizing(surface, remesh.sizing), remesh.samples, options.surface);
  return remesh;
}

RemeshResult on_surface(RemeshResult coarse, const geom::TriMesh& surface, const Sizing& sizing,
                        const RemeshOptions& options) {
  coarse.sizing.clear();
  for (std::size_t v = 0; v < surface.num_vertices(); ++v)
    coarse.sizing.push_back(sizing.at(geom::VertexId(v)));
  return with_mesh_on(surface, std::move(coarse), options);
}

}  // namespace fpo
