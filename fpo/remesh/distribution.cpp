#include "fpo/remesh/distribution.h"

#include <algorithm>

#include "fpo/remesh/coarse_start.h"
#include "fpo/remesh/stand_in.h"
#include "fpo/remesh/start.h"
#include "geom/mesh/scaling.h"

namespace fpo {

SurfaceOptions surface_options(const SharedSizing& shared, const RemeshOptions& options) {
  SurfaceOptions result = options.surface;
  result.seed = options.seed;
  result.threads = options.threads;
  result.num_fixed = shared.features.samples.size();
  return result;
}

namespace {

constexpr double gain_apart = 3e-4;  // of mean delta, in five iterations: a move costs several times as much
constexpr int start_saves = 3;       // times as many iterations, for samples that are spread already

void remove_short_edges(SurfaceDomain& domain, const RemeshOptions& options, RemeshResult& result) {
  ShortestEdgeOptions removal;
  removal.interrupted = options.optimize.interrupted;
  result.shortest_edges = remove_shortest_edges(domain, removal);
}

/// What is optimized, and how.
struct Optimization {
  const geom::TriMesh& surface;
  const Sizing& sizing;
  SurfaceOptions diagram;
  OptimizeOptions how;
};

/// Farthest point optimization, in tiles if the samples are many.
SurfaceDomain optimized(const Optimization& task, std::vector<SurfaceSample> samples,
                        const RemeshOptions& options, OptimizeResult& result) {
  if (options.tile_samples == 0 || samples.size() <= options.tile_samples || task.surface.has_levels()) {
    SurfaceDomain domain(task.surface, task.sizing, samples, task.diagram);
    result = optimize(domain, task.how);
    return domain;
  }
  TileOptions tiles;
  tiles.most_samples = options.tile_samples;
  tiles.threads = options.threads;
  return optimize_in_tiles({task.surface, task.sizing, std::move(samples), task.diagram}, tiles, task.how,
                           result);
}

/// The same, all iterations but the last on the coarser surface.
SurfaceDomain optimized_in_parts(const geom::TriMesh& coarse, Optimization task,
                                 std::vector<SurfaceSample> samples, const RemeshOptions& options,
                                 OptimizeResult& result) {
  OptimizeResult first;
  const Sizing sizing = sizing_on(coarse, task.sizing);
  std::vector<SurfaceSample> settled =
      brought_to(task.surface, samples_of(optimized({coarse, sizing, task.diagram, first_part(task.how)},
                                                    brought_to(coarse, samples), options, first)));
  std::copy_n(samples.begin(), task.diagram.num_fixed, settled.begin());
  result = first;
  if (first.reason == StopReason::interrupted)
    return SurfaceDomain(task.surface, task.sizing, settled, task.diagram);
  task.how = last_part(task.how, first);
  SurfaceDomain domain = optimized(task, std::move(settled), options, result);
  result = both_parts(first, result);
  return domain;
}

/// By farthest point optimization.
SurfaceDomain optimized_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                const RemeshResult* start, const RemeshOptions& options,
                                RemeshResult& result) {
  Optimization task{surface, shared.sizing, surface_options(shared, options), options.optimize};
  task.how.seed = options.seed;
  task.how.order = VisitOrder::in_turn;  // the initial samples are in random order already
  if (task.how.on_iteration)
    task.how.on_iteration = [&result, &options](const IterationReport& report) {
      result.iterations.push_back(report);
      options.optimize.on_iteration(report);
    };
  std::vector<SurfaceSample> samples = initial_samples(surface, shared, options.num_samples, options.seed);
  if (start) {
    take_inner(brought_to(surface, start->samples), start->feature_samples, task.diagram.num_fixed, samples);
    result.coarse_facets = start->coarse_facets;
    task.how.max_iterations =
        std::min(task.how.max_iterations, std::max(task.how.max_iterations / start_saves, 1));
  }
  if (surface.has_levels()) task.how.least_gain = gain_apart;
  if (options.shortest_edge_removal) {
    SurfaceDomain domain(surface, shared.sizing, samples, task.diagram);
    remove_short_edges(domain, options, result);
    samples = samples_of(domain);
  } else if (options.coarse_start && !start && has_two_parts(task.how)) {
    if (const auto coarse = coarse_surface(surface, shared.sizing, options.num_samples)) {
      result.coarse_facets = coarse->num_facets();
      return optimized_in_parts(*coarse, std::move(task), std::move(samples), options, result.optimization);
    }
  }
  return optimized(task, std::move(samples), options, result.optimization);
}

/// Another method. Its disks have their squared radii as weights; without disks the cells are Voronoi cells.
SurfaceDomain baseline_samples(const MethodFacts& method, const geom::TriMesh& surface,
                               const SharedSizing& shared, const RemeshOptions& options,
                               RemeshResult& result) {
  std::vector<SurfaceSample> fixed = shared.features.samples;
  for (SurfaceSample& x : fixed) x.position = geom::snapped(x.position);
  BaselineTask task{surface, shared.sizing, fixed, options.num_samples, options.seed, options.threads};
  if (options.disk_radius > 0) task.radius_factor = options.disk_radius / shared.sizing.at(geom::VertexId(0));
  const BaselineResult baseline = method.distribute(task, options.optimize);
  result.optimization = baseline.run;
  result.radius_factor = baseline.radius_factor;
  result.reached = baseline.reached;
  SurfaceOptions diagram = surface_options(shared, options);
  diagram.weighted = baseline.radius_factor > 0;
  if (diagram.weighted) diagram.weight_factor = baseline.radius_factor;
  return SurfaceDomain(surface, shared.sizing, baseline.samples, diagram);
}

}  // namespace

SurfaceDomain distributed_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                  const RemeshResult* start, const RemeshOptions& options,
                                  RemeshResult& result) {
  const MethodFacts& method = facts_of(options.method);
  if (method.distribute) return baseline_samples(method, surface, shared, options, result);
  return optimized_samples(surface, shared, start, options, result);
}

SurfaceDomain same_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                           const RemeshResult& before, const RemeshOptions& options, RemeshResult& result) {
  result.shortest_edges = before.shortest_edges;
  result.optimization = before.optimization;
  result.iterations = before.iterations;
  result.coarse_facets = before.coarse_facets;
  if (options.optimize.on_iteration)  // who keeps those of the last optimization has these again
    for (const IterationReport& report : before.iterations) options.optimize.on_iteration(report);
  return SurfaceDomain(surface, shared.sizing, before.samples, surface_options(shared, options));
}

SurfaceDomain settled_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                              const RemeshResult& coarse, const RemeshOptions& options,
                              RemeshResult& result) {
  std::vector<SurfaceSample> samples = initial_samples(surface, shared, options.num_samples, options.seed);
  take_inner(coarse.samples, coarse.feature_samples, shared.features.samples.size(), samples);
  SurfaceDomain domain(surface, shared.sizing, samples, surface_options(shared, options));
  OptimizeOptions once = options.optimize;
  once.max_iterations = 1;
  once.on_iteration = {};
  const OptimizeResult last = optimize(domain, once);
  result.stood_in = true;
  result.optimization = coarse.optimization;
  result.iterations = coarse.iterations;
  result.optimization.moves += last.moves;
  result.optimization.last.delta = last.last.delta;
  result.optimization.last.mean_delta = last.last.mean_delta;
  if (last.reason == StopReason::interrupted) result.optimization.reason = last.reason;
  return domain;
}

}  // namespace fpo
