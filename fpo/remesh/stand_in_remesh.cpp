#include "fpo/remesh/stand_in_remesh.h"

#include <utility>

#include "fpo/interruption.h"
#include "fpo/remesh/coarse_start.h"
#include "fpo/remesh/last_angles.h"
#include "fpo/remesh/refusal.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/stand_in.h"
#include "geom/check.h"

namespace fpo {

namespace {

bool may_stand_in(const RemeshOptions& options) {
  return options.method == Method::fpo && options.optimize.max_iterations > 0 &&
         !(options.features && !options.features->marked.empty());
}

/// Its samples brought to the surface. None if it is refused.
std::optional<RemeshResult> remesh_there(const geom::TriMesh& coarse, const geom::TriMesh& surface,
                                         RemeshOptions options, const RemeshFunction& remesh) try {
  options.fixed.clear();
  options.keep_cells = false;
  RemeshResult result = remesh(coarse, options);
  result.samples = brought_to(surface, std::move(result.samples), coarse);
  result.stood_in = true;
  result.made_coarser = false;  // what that surface was remeshed on is its own affair
  return result;
} catch (const geom::InputError&) {  // what can be done on the coarser surface only is not asked for
  return {};
}

}  // namespace

std::optional<RemeshResult> remesh_of_stand_in(const geom::TriMesh& surface, const RemeshOptions& options,
                                               const RemeshFunction& remesh) {
  const double spacing = even_spacing(surface, options);
  if (!may_stand_in(options) || !has_needles(surface, options.num_samples, spacing)) return {};
  const geom::TriMesh coarse = stand_in(surface, spacing);
  if (has_needles(coarse, options.num_samples, spacing)) return {};
  return remesh_there(coarse, surface, options, remesh);
}

bool may_be_coarser(const geom::TriMesh& surface, const Features& features, const RemeshOptions& options) {
  return is_dense_for_all(surface, options.num_samples) && may_stand_in(options) && options.fixed.empty() &&
         options.coarse_start && options.coarse_for_all && options.mend && !options.shortest_edge_removal &&
         !has_creases(features);
}

std::optional<RemeshResult> remesh_of_coarser(const geom::TriMesh& surface, const Sizing& sizing,
                                              const RemeshOptions& options,
                                              const RemeshFunction& remesh) try {
  const WantedType type(surface, {});
  if (type.branches) return {};
  const std::optional<geom::TriMesh> coarse = coarse_surface_for_all(surface, sizing, options.num_samples);
  if (!coarse) return {};
  RemeshOptions there = options;
  if (there.features) there.features->crease_angle = there.features->weak_crease_angle = 180;
  std::optional<RemeshResult> result = remesh_there(*coarse, surface, there, remesh);
  if (!result || is_remnant(result->mesh)) return {};
  result->coarse_facets = coarse->num_facets();
  result->made_coarser = true;
  result->type = check_type(type, result->mesh, result->samples);
  return on_surface(std::move(*result), surface, sizing, options);
} catch (const geom::Interrupted&) {
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
