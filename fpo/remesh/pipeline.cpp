#include "fpo/remesh/pipeline.h"

#include <string>

#include "fpo/features/corner_angles.h"
#include "fpo/features/curve_slides.h"
#include "fpo/features/curve_spacing.h"
#include "fpo/features/feature_choice.h"
#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/proven_edges.h"
#include "fpo/remesh/small_loops.h"
#include "fpo/remesh/stand_in.h"
#include "fpo/remesh/start.h"
#include "fpo/surface/sheet_levels.h"
#include "geom/check.h"
#include "geom/mesh/centring.h"
#include "geom/mesh/scaling.h"

namespace fpo {
namespace {

constexpr int futile_mending_rounds = 10;  // in a row, without fewer defects
constexpr std::size_t least_fidelity_moves = 2000;
constexpr int start_saves = 3;  // times as many iterations, for samples that are spread already

const ThinPartOptions thin;  // how far lengths may change from place to place, and others be stretched

double even_spacing(const geom::TriMesh& surface, const RemeshOptions& options) {
  return hexagonal_spacing(surface.area(), options.num_samples);
}

FeatureChoice chosen_features(const geom::TriMesh& surface, const RemeshOptions& options) {
  if (!options.features) return {};
  const std::vector<SurfaceSample> fixed = points_on_surface(surface, options.fixed);
  return choose_features(
      surface, *options.features,
      {options.num_samples, even_spacing(surface, options), fixed, options.strong_creases_only});
}

/// Beside narrow places: steeper than elsewhere, for what is refined there is taken from all others.
double curve_gradation(const RemeshOptions& options) { return std::max(0.18, options.limits.gradation); }

using SizingFor = std::function<Sizing(std::size_t)>;

/// The wanted lengths for any number of samples, were there no features.
SizingFor plain_sizing(const geom::TriMesh& surface, const RemeshOptions& options) {
  const auto rho_of = facts_of(options.sizing).rho;
  if (!rho_of)
    return [&surface](std::size_t n) { return Sizing::uniform(hexagonal_spacing(surface.area(), n)); };
  return [&surface, limits = options.limits,
          rho = rho_of({surface, options.num_samples, even_spacing(surface, options), options.rho,
                        options.threads})](std::size_t n) { return fit_sizing(surface, rho, n, limits); };
}

/// What is remeshed: the input, or the same with smaller facets.
struct Task {
  const geom::TriMesh& input;
  const SizingFor& plain;
  const NarrowSurface* narrow;  ///< null: where curves are nowhere close to each other
  Features features;
  bool only_apart = false;              ///< there is nothing to do without sheets that are near each other
  const RemeshResult* start = nullptr;  ///< its samples are those to begin with
  const geom::TriMesh& surface() const { return narrow ? narrow->split.mesh : input; }
};

/// The sizing, and the samples that stay.
SharedSizing sizing_and_features(const Task& task, const RemeshOptions& options) {
  const auto sizing_for = [&](std::size_t n) {
    if (!task.narrow) return task.plain(n);
    return fit_sizing_to_curves(task.input, task.plain(n), *task.narrow, n).sizing;
  };
  SharedSizing shared =
      share_sizing(task.surface(), task.features, points_on_surface(task.surface(), options.fixed),
                   sizing_for, {options.num_samples, options.seed, {}, options.facing_samples});
  // Room is made in even lengths only: of lengths that were asked for none is changed.
  if (options.mend && options.method == Method::fpo && options.sizing == SizingKind::uniform)
    shared.sizing = make_room_for_small_loops(task.surface(), shared, options.num_samples, thin.gradation,
                                              thin.most_scale)
                        .sizing;
  return shared;
}

bool interrupted(const RemeshOptions& options) { return fpo::interrupted(options.optimize.interrupted); }

AngleOptions angle_options(const RemeshOptions& options) {
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  return angles;
}

/// The remesh, after some rounds of refinement where it is no surface: the one with the fewest defects.
Dual mended_dual(SurfaceDomain& domain, const FeatureSamples& features, const geom::SurfaceType& type,
                 const RemeshOptions& options, RemeshResult& counts) {
  const auto next_dual = [&] {
    if (options.mend) counts.protection += protect_chains(domain, features);
    return dual_of(domain, type, options.keep_cells);
  };
  Dual best = next_dual();
  std::vector<Defect> defects = best.defects;
  for (int futile = 0;
       futile < futile_mending_rounds && options.mend && !defects.empty() && !interrupted(options);
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
  optimize_angles(domain, angle_options(options));  // around the samples brought
  Dual better = next_dual();
  return better.type.ok() ? better : best;
}

SurfaceOptions surface_options(const SharedSizing& shared, const RemeshOptions& options) {
  SurfaceOptions result = options.surface;
  result.seed = options.seed;
  result.threads = options.threads;
  result.num_fixed = shared.features.samples.size();
  return result;
}

void remove_short_edges(SurfaceDomain& domain, const RemeshOptions& options, RemeshResult& result) {
  if (!options.shortest_edge_removal) return;
  ShortestEdgeOptions removal;
  removal.interrupted = options.optimize.interrupted;
  result.shortest_edges = remove_shortest_edges(domain, removal);
}

RemeshResult remesh_in_unit_box(const geom::TriMesh& surface, const RemeshOptions& options);

/// Where the surface is made of needles: the remesh of a coarser one, its samples brought to the surface.
/// None where it is not, or none can be had.
std::optional<RemeshResult> remesh_of_stand_in(const geom::TriMesh& surface,
                                               const RemeshOptions& options) try {
  const double spacing = hexagonal_spacing(surface.area(), options.num_samples);
  if (options.method != Method::fpo || options.optimize.max_iterations == 0) return {};
  if (!has_needles(surface, options.num_samples, spacing)) return {};
  const geom::TriMesh coarse = stand_in(surface, spacing);
  if (has_needles(coarse, options.num_samples, spacing)) return {};
  RemeshOptions there = options;
  there.fixed.clear();
  there.keep_cells = false;
  if (options.features && !options.features->marked.empty()) return {};
  RemeshResult result = remesh_in_unit_box(coarse, there);
  result.samples = brought_to(surface, std::move(result.samples));
  result.stood_in = true;
  return result;
} catch (const geom::InputError&) {  // what can be done on the coarser surface only is not asked for
  return {};
}

/// It as the result, for there is no time for another one.
RemeshResult on_surface(RemeshResult coarse, const geom::TriMesh& surface, const Sizing& sizing) {
  geom::Table<geom::VertexId, geom::Vec3> positions;
  for (const SurfaceSample& x : coarse.samples) positions.push_back(x.position);
  coarse.mesh = geom::TriMesh(std::move(positions), coarse.mesh.facets());
  coarse.sizing.clear();
  for (std::size_t v = 0; v < surface.num_vertices(); ++v)
    coarse.sizing.push_back(sizing.at(geom::VertexId(v)));
  return coarse;
}

/// What is left to do where they are brought to: the features are its own, and may have pushed them aside.
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
  result.optimization.moves += last.moves;
  result.optimization.last.delta = last.last.delta;
  result.optimization.last.mean_delta = last.last.mean_delta;
  if (last.reason == StopReason::interrupted) result.optimization.reason = last.reason;
  return domain;
}

/// Farthest point optimization.
SurfaceDomain optimized_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                const RemeshResult* start, const RemeshOptions& options,
                                RemeshResult& result) {
  OptimizeOptions optimization = options.optimize;
  optimization.seed = options.seed;
  optimization.order = VisitOrder::in_turn;  // the initial samples are in random order already
  const SurfaceOptions diagram = surface_options(shared, options);
  std::vector<SurfaceSample> samples = initial_samples(surface, shared, options.num_samples, options.seed);
  if (start) {
    take_inner(brought_to(surface, start->samples), start->feature_samples, diagram.num_fixed, samples);
    optimization.max_iterations =
        std::min(optimization.max_iterations, std::max(optimization.max_iterations / start_saves, 1));
  }
  if (options.tile_samples == 0 || samples.size() <= options.tile_samples || surface.has_levels()) {
    SurfaceDomain domain(surface, shared.sizing, samples, diagram);
    remove_short_edges(domain, options, result);
    result.optimization = optimize(domain, optimization);
    return domain;
  }
  if (options.shortest_edge_removal) {
    SurfaceDomain domain(surface, shared.sizing, samples, diagram);
    remove_short_edges(domain, options, result);
    samples = samples_of(domain);
  }
  TileOptions tiles;
  tiles.most_samples = options.tile_samples;
  tiles.threads = options.threads;
  return optimize_in_tiles({surface, shared.sizing, std::move(samples), diagram}, tiles, optimization,
                           result.optimization);
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

/// The samples by the method wanted, with their diagram.
SurfaceDomain distributed_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                  const RemeshResult* start, const RemeshOptions& options,
                                  RemeshResult& result) {
  const MethodFacts& method = facts_of(options.method);
  if (method.distribute) return baseline_samples(method, surface, shared, options, result);
  return optimized_samples(surface, shared, start, options, result);
}

/// The surface with its sheets apart, if it has some that are near each other and that is wanted.
std::optional<SplitSurface> surface_apart(const Task& task, SharedSizing& shared,
                                          const RemeshOptions& options) {
  if (options.sheets != Sheets::apart || facts_of(options.method).distribute) return {};
  return sheets_apart(task.surface(), shared.sizing, shared.features.samples);
}

/// The samples become those of the old surface again.
void return_to(const SplitSurface& apart, RemeshResult& result) {
  for (SurfaceSample& x : result.samples) x.facet = apart.parents[x.facet];
  for (CellPolygon& cell : result.cells) cell.facet = apart.parents[cell.facet];
}

/// More samples where the surface is thin.
std::unique_ptr<SurfaceDomain> with_room(std::unique_ptr<SurfaceDomain> domain, const SharedSizing& shared,
                                         const geom::SurfaceType& type, const RemeshOptions& options,
                                         RemeshResult& result) {
  if (!options.mend) return domain;
  result.protection = protect_chains(*domain, shared.features);
  if (options.method != Method::fpo || !type.manifold) return domain;
  ThinPartOptions room = thin;
  room.diagram = surface_options(shared, options);
  room.scope = options.optimize.scope;
  room.interrupted = options.optimize.interrupted;
  return make_room_for_thin_parts(std::move(domain), shared.features, type, room, result.thin_parts);
}

void count_creases(const Features& features, const FeatureSamples& samples, RemeshResult& result) {
  for (std::size_t c = 0; c < features.curves.size(); ++c)
    if (features.curves[c].sheets == 2)
      ++result.crease_curves, result.crease_edges += samples.chains[c].size() - 1;
}

/// What follows the optimization: angles, fidelity.
void improve(SurfaceDomain& domain, const SharedSizing& shared, const AngleOptions& angles,
             const RemeshOptions& options, RemeshResult& result) {
  if (options.optimize_angles) result.angles = optimize_angles(domain, angles);
  if (!options.improve_fidelity || result.stood_in) return;
  FidelityOptions fidelity;
  fidelity.enough_delta = options.angles.enough_delta;
  fidelity.interrupted = options.optimize.interrupted;
  const bool has_features = !shared.features.samples.empty();
  if (options.method == Method::fpo)  // who wants it fast wants this fast, too
    fidelity.most_moves = least_fidelity_moves + result.optimization.moves / (has_features ? 4 : 12);
  if (has_features) {  // fixed samples keep delta from more, and shape matters more
    fidelity.share_of_largest = 0.5;
    fidelity.enough_delta = std::min(0.9, fidelity.enough_delta);
  }
  result.fidelity = improve_fidelity(domain, angles, fidelity);
}

RemeshResult remesh_task(const Task& task, RemeshOptions options) {
  RemeshResult result;
  SharedSizing shared = sizing_and_features(task, options);
  if (interrupted(options)) throw geom::Interrupted();
  if (task.narrow && options.sizing == SizingKind::uniform) {
    options.optimize.scope = Scope::two_ring;
    options.surface.weight_factor = best_weight_factor(options.optimize.scope);
    const MethodFacts& facts = facts_of(options.method);  // unless another number was asked for
    if (options.optimize.max_iterations == facts.iterations)
      options.optimize.max_iterations = facts.adaptive_iterations;
  }
  std::optional<RemeshResult> coarse;
  if (!task.narrow) coarse = remesh_of_stand_in(task.input, options);
  if (coarse && interrupted(options) && options.fixed.empty() && !options.keep_cells)
    return on_surface(std::move(*coarse), task.input, shared.sizing);
  std::optional<SplitSurface> apart;
  if (!coarse) apart = surface_apart(task, shared, options);
  if (task.only_apart && !apart) return result;
  if (apart && !apart->h.empty()) shared.sizing = Sizing(apart->mesh, apart->h);
  const geom::TriMesh& surface = apart ? apart->mesh : task.surface();
  const geom::SurfaceType type = geom::surface_type(surface);
  auto distributed = std::make_unique<SurfaceDomain>(
      coarse ? settled_samples(surface, shared, *coarse, options, result)
             : distributed_samples(surface, shared, task.start, options, result));
  const std::unique_ptr<SurfaceDomain> samples =
      with_room(std::move(distributed), shared, type, options, result);
  SurfaceDomain& domain = *samples;
  const Sizing& sizing = domain.sizing();
  AngleOptions angles = angle_options(options);
  std::optional<CurveSlides> slides;
  if (!shared.features.chains.empty()) slides.emplace(task.surface(), task.features, shared.features, sizing);
  if (slides && !apart) angles.slides = &*slides;
  improve(domain, shared, angles, options, result);
  if (options.maximal)
    result.maximal =
        make_maximal(domain, {shared.features.samples.size(), options.threads, options.optimize.interrupted});
  result.hidden = domain.num_hidden();
  Dual dual = mended_dual(domain, shared.features, type, options, result);
  if (!apart) result.proven_edges = num_proven_edges(domain, task.features, shared.features);
  if (options.mend && options.method == Method::fpo && !interrupted(options))
    result.finish = finish(domain, shared.features, type,
                           {angle_options(options), options.optimize_angles && !options.maximal,
                            options.keep_cells, slides ? &*slides : nullptr},
                           dual);
  result.type = dual.type;
  result.advice = type_advice(dual, surface, type, sizing);
  result.localization = dual.localization;
  result.mesh = std::move(dual.mesh);
  result.samples = std::move(dual.samples);
  result.cells = std::move(dual.cells);
  result.feature_samples = shared.features.samples.size();
  result.feature_edges = num_edges(shared.features);
  result.corner_angle = smallest_corner_angle(task.surface(), task.features);
  count_creases(task.features, shared.features, result);
  const auto broken = broken_edges(result.mesh, shared.features);
  result.broken_feature_edges = broken.size();
  result.edge_advice = edge_advice(result.mesh, broken);
  for (std::size_t v = 0; v < task.input.num_vertices(); ++v)
    result.sizing.push_back(sizing.at(geom::VertexId(v)));
  for (const SurfaceSample& sample : result.samples) result.wanted.push_back(sizing.at(sample));
  result.fit = sizing_fit(result.mesh, result.wanted);
  result.measures =
      final_measures(result.mesh, result.wanted, result.feature_samples, angle_options(options));
  result.angles.bad_after = result.measures.bad_triangles;
  result.has_levels = apart.has_value();
  if (apart) return_to(*apart, result);
  return result;
}

/// The surface with small facets if there are narrow places that smaller lengths help.
std::optional<NarrowSurface> helpful_narrow_surface(const geom::TriMesh& surface, const Features& features,
                                                    const SizingFor& plain, const RemeshOptions& options) {
  const bool has_marks = options.features && !options.features->marked.empty();  // on facets as they are
  if (options.method != Method::fpo || has_marks) return {};
  std::optional<NarrowSurface> narrow =
      narrow_surface(surface, features, even_spacing(surface, options), curve_gradation(options));
  const std::size_t n = options.num_samples;
  if (narrow && !fit_sizing_to_curves(surface, plain(n), *narrow, n).helped) narrow.reset();
  return narrow;
}

/// `only_apart`: no mesh if there are no sheets to be set apart.
RemeshResult remesh_with(const geom::TriMesh& surface, const FeatureChoice& choice,
                         const RemeshOptions& options, const RemeshResult* start = nullptr,
                         bool only_apart = false) {
  const SizingFor plain = plain_sizing(surface, options);
  const std::optional<NarrowSurface> narrow =
      helpful_narrow_surface(surface, choice.features, plain, options);
  RemeshResult result;
  if (narrow) {
    const Features features = chosen_features(narrow->split.mesh, options).features;
    result = remesh_task({surface, plain, &*narrow, features, only_apart, start}, options);
    return_to(narrow->split, result);
  } else {
    result = remesh_task({surface, plain, nullptr, choice.features, only_apart, start}, options);
  }
  result.given_up = choice.given_up;
  return result;
}

/// Sheets that are left to us are together unless that does harm and being apart helps. Samples of close
/// curves face each other if edges of curves are lost else.
RemeshResult remesh_sheets(const geom::TriMesh& surface, const FeatureChoice& choice,
                           const RemeshOptions& options) {
  RemeshResult best = remesh_with(surface, choice, options);
  if (options.sheets != Sheets::automatic || options.method != Method::fpo || is_fine(best)) return best;
  RemeshOptions with_levels = options;
  with_levels.sheets = Sheets::apart;
  const auto attempt = [&](const RemeshOptions& otherwise, bool only_apart) {
    if (interrupted(options)) return;
    RemeshResult other = remesh_with(surface, choice, otherwise, &best, only_apart);
    if (interrupted(options) || (only_apart && !other.has_levels)) return;
    if (is_better(other, best)) best = std::move(other);
  };
  attempt(with_levels, true);
  if (best.broken_feature_edges > 0) {
    RemeshOptions facing = options;
    facing.facing_samples = true;
    facing.sheets = best.has_levels ? Sheets::apart : Sheets::together;
    attempt(facing, false);
  }
  return best;
}

/// Only the strongest creases, if that is of use where all of them are not; else none.
RemeshResult remesh_with_fewer_creases(const geom::TriMesh& surface, RemeshResult result,
                                       const RemeshOptions& options) {
  const std::string harm =
      "with " + std::to_string(result.crease_curves) + " curves kept " +
      (result.type.ok() ? "angles would be useless" : "the remesh would be of another type");
  const auto attempt = [&](const RemeshOptions& fewer, const FeatureChoice& choice) {
    if (interrupted(options)) return false;
    RemeshResult other = remesh_sheets(surface, choice, fewer);
    if (interrupted(options) || !other.type.ok() || !is_better(other, result)) return false;
    result = std::move(other);
    return true;
  };
  RemeshOptions fewer = options;
  fewer.strong_creases_only = true;
  const FeatureChoice strong = chosen_features(surface, fewer);
  if (!strong.given_up.empty() && !strong.features.curves.empty()) attempt(fewer, strong);
  if (!is_useless(result)) return result;
  RemeshOptions without = options;
  without.features->crease_angle = without.features->weak_crease_angle = 180;
  if (attempt(without, chosen_features(surface, without)))
    result.given_up = "creases dropped: " + harm + "; --features 45 keeps them";
  return result;
}

/// Creases that nobody asked for are kept unless that alone does harm.
RemeshResult remesh_in_unit_box(const geom::TriMesh& surface, const RemeshOptions& options) {
  RemeshResult result = remesh_sheets(surface, chosen_features(surface, options), options);
  if (result.crease_curves == 0 || !options.features->yielding || options.method != Method::fpo ||
      interrupted(options) || !geom::topology(surface).manifold() || is_useful(result))
    return result;
  return remesh_with_fewer_creases(surface, std::move(result), options);
}

/// Around the origin.
RemeshResult remesh_there(const geom::TriMesh& input, const RemeshOptions& options) {
  const double factor = geom::factor_to_unit_box(input);
  const geom::TriMesh surface = geom::scaled_to_unit_box(input, factor);
  geom::require(surface.area() > 0, "the surface has no area");
  RemeshOptions scaled_options = options;
  for (geom::Vec3& point : scaled_options.fixed) point *= factor;
  scaled_options.disk_radius *= factor;
  RemeshResult result = remesh_in_unit_box(surface, scaled_options);
  result.mesh = geom::scaled(result.mesh, 1 / factor);
  for (SurfaceSample& sample : result.samples) sample.position /= factor;
  for (geom::Vec3& place : result.advice.places) place /= factor;
  result.edge_advice.first /= factor;
  for (double& h : result.sizing) h /= factor;
  for (double& h : result.wanted) h /= factor;
  for (CellPolygon& cell : result.cells)
    for (geom::Vec3& corner : cell.corners) corner /= factor;
  return result;
}

}  // namespace

RemeshResult remesh(const geom::TriMesh& input, const RemeshOptions& options) try {
  geom::require(options.num_samples > 0, "the number of samples must be at least 1");
  geom::require(options.disk_radius == 0 || options.sizing == SizingKind::uniform,
                "a radius of disks goes with uniform sizing only");
  const geom::Vec3 middle = geom::far_middle(input);
  if (middle.isZero(0)) return remesh_there(input, options);
  RemeshOptions moved_options = options;
  for (geom::Vec3& point : moved_options.fixed) point -= middle;
  RemeshResult result = remesh_there(geom::moved_by(input, -middle), moved_options);
  result.mesh = geom::moved_by(result.mesh, middle);
  for (SurfaceSample& sample : result.samples) sample.position += middle;
  for (geom::Vec3& place : result.advice.places) place += middle;
  result.edge_advice.first += middle;
  for (CellPolygon& cell : result.cells)
    for (geom::Vec3& corner : cell.corners) corner += middle;
  return result;
} catch (const geom::Bug& bug) {
  throw geom::Bug("seed " + std::to_string(options.seed) + ", " + bug.what());
}

}  // namespace fpo
