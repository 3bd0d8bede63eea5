#include "fpo/remesh/attempt.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fpo/features/curve_slides.h"
#include "fpo/features/split_features.h"
#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/distribution.h"
#include "fpo/remesh/improvement.h"
#include "fpo/remesh/last_resort.h"
#include "fpo/remesh/proven_edges.h"
#include "fpo/remesh/refusal.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/return_to.h"
#include "fpo/remesh/stand_in.h"
#include "fpo/remesh/stand_in_remesh.h"
#include "fpo/remesh/surface_apart.h"

namespace fpo {
namespace {

constexpr int glance = 20, least_share_of_all = 2;  // iterations; times, of all
constexpr double some_near_itself = 0.005;          // of the surface

bool was_interrupted(const RemeshOptions& options) { return fpo::interrupted(options.optimize.interrupted); }

/// More samples where the surface is thin. Those of a coarser one are there already.
std::unique_ptr<SurfaceDomain> with_room(std::unique_ptr<SurfaceDomain> domain, const SharedSizing& shared,
                                         const WantedType& type, const RemeshOptions& options,
                                         RemeshResult& result, bool only_look = false) {
  if (!options.mend) return domain;
  if (result.thin_parts.faults_before == 0)
    result.protection = protect_chains(*domain, shared.features, options.optimize.interrupted);
  if (options.method != Method::fpo || type.branches || result.stood_in || was_interrupted(options))
    return domain;
  ThinPartOptions room;
  room.rounds = only_look ? 0 : options.rounds_for_thin_parts;
  room.diagram = surface_options(shared, options);
  room.scope = options.optimize.scope;
  room.interrupted = options.optimize.interrupted;
  return make_room_for_thin_parts(std::move(domain), shared.features, type, room, result.thin_parts);
}

/// Lengths that differ at narrow places are reached as those of any other sizing are.
void optimize_as_adaptive(RemeshOptions& options) {
  options.optimize.scope = Scope::two_ring;
  options.surface.weight_factor = best_weight_factor(options.optimize.scope);
  const MethodFacts& facts = facts_of(options.method);  // unless another number was asked for
  if (options.optimize.max_iterations == facts.iterations)
    options.optimize.max_iterations = facts.adaptive_iterations;
}

void take(Dual dual, RemeshResult& result) {
  result.type = dual.type;
  result.localization = dual.localization;
  result.mesh = std::move(dual.mesh);
  result.samples = std::move(dual.samples);
  result.cells = std::move(dual.cells);
}

/// Is mending, which is still to come, to lead to the type?
bool is_at_fault(const RemeshResult& result) {
  return result.by_collapses || (result.thin_parts.faults_before > 0 && !result.thin_parts.right_type);
}

/// No mesh, for that is better made otherwise, with these samples to begin with.
RemeshResult only_samples(const SurfaceDomain& domain, RemeshResult result) {
  result.samples = samples_of(domain);
  while (result.feature_samples < result.samples.size() &&
         domain.is_fixed(geom::SiteId(result.feature_samples)))
    ++result.feature_samples;
  return result;
}

bool has_triangles(const SurfaceDomain& domain) {
  for (std::size_t i = 0; i < domain.num_samples(); ++i)
    if (has_triangle(domain, geom::SiteId(i))) return true;
  return false;
}

/// Of so few samples that their diagram has no triangle. None if there are vertices left.
std::optional<RemeshResult> without_diagram(const SampledTask& sampled, const RemeshOptions& options,
                                            RemeshResult result) {
  result.samples.assign(sampled.unmended.begin(), sampled.unmended.end());
  result.type.bare_samples = result.samples.size();
  result.has_levels = sampled.apart != nullptr;
  const std::shared_ptr<const RemeshResult> made = last_resort(sampled, options, result);
  if (!made) return {};
  result = *made;
  if (sampled.apart) return_to(*sampled.apart, result);
  return result;
}

/// Samples that have found their places.
struct PlacedTask {
  const RemeshTask& task;
  const SharedSizing& shared;
  const SplitSurface* apart;  ///< null: sheets are as they are
  const WantedType& type;     ///< of the surface
  bool came_with_faults;      ///< from a remesh of another type
};

/// Their remesh, mended, with what is told of it.
RemeshResult remesh_of(std::unique_ptr<SurfaceDomain> samples, const PlacedTask& placed,
                       const RemeshOptions& options, RemeshResult result) {
  const auto& [task, shared, apart, type, came_with_faults] = placed;
  SurfaceDomain& domain = *samples;
  const geom::TriMesh& surface = apart ? apart->mesh : task.surface();
  const Sizing sizing = domain.sizing();
  AngleOptions angles = angle_options(options);
  std::optional<CurveSlides> slides;
  if (!shared.features.chains.empty()) slides.emplace(task.surface(), task.features, shared.features, sizing);
  if (slides && !apart) angles.slides = &*slides;
  const bool provable = slides && !apart && options.mend && options.method == Method::fpo;
  std::vector<SurfaceSample> unmended;
  if (is_at_fault(result) || came_with_faults) unmended = samples_of(domain);
  Dual dual =
      improved_dual(domain, {shared, type, provable ? &task.features : nullptr, angles}, options, result);
  if (!apart && !was_interrupted(options))
    result.proven_edges = num_proven_edges(domain, task.features, shared.features);
  if (options.mend && options.method == Method::fpo && !was_interrupted(options))
    result.finish = finish(std::move(samples), shared.features, type,
                           {.angles = angle_options(options),
                            .mend_angles = options.optimize_angles && !options.maximal,
                            .all_wanted = options.closer == Closer::always || result.closeness.mended > 0,
                            .least_edge = std::min(options.closer_delta, options.angles.enough_delta),
                            .keep_cells = options.keep_cells,
                            .slides = slides ? &*slides : nullptr},
                           dual);
  result.advice = type_advice(dual, surface, type, sizing);
  take(std::move(dual), result);
  tell_of_features(task, shared, result);
  tell_of_lengths(task, sizing, angle_options(options), result);
  result.has_levels = apart != nullptr;
  result.has_facing_samples = options.facing_samples;
  result.last_resort = last_resort({task, shared, sizing, apart, type, slides ? &*slides : nullptr, unmended},
                                   options, result);
  return result;
}

/// Samples after some iterations, if these are few of all; cut short if they are at fault then,
/// and the sheets can be set apart: what more would be done with these together is left out. If not, all
/// begins anew.
std::optional<RemeshResult> glanced_at(const RemeshTask& task, const SharedSizing& shared,
                                       const WantedType& type, RemeshOptions options) {
  if (!options.may_cut_short || options.optimize.max_iterations < least_share_of_all * glance ||
      type.branches)
    return {};
  options.optimize.max_iterations = glance;
  RemeshResult result;
  auto samples =
      std::make_unique<SurfaceDomain>(distributed_samples(task.surface(), shared, nullptr, options, result));
  samples = with_room(std::move(samples), shared, type, options, result, true);
  result.cut_short = !was_interrupted(options) && result.thin_parts.faults_before > 0 &&
                     has_near_sheets(task, shared, options);
  return only_samples(*samples, std::move(result));
}

/// The paper, in a line; what is not in it comes in between. If sheets are left to us and near each other,
/// and the diagram of space is not of the input's type, there are only samples.
RemeshResult remesh_task(const RemeshTask& task, RemeshOptions options, const RemeshFunction& coarser) {
  RemeshResult result;
  SharedSizing shared = sizing_and_features(task, options);
  if (was_interrupted(options) && !task.start) throw geom::Interrupted();
  if (!shared.sizing.is_even() && options.sizing == SizingKind::uniform) optimize_as_adaptive(options);
  if (task.only_apart && has_needles(task.surface(), options.num_samples, even_spacing(task.input, options)))
    return result;  // each cell would be cut to thousands of parts
  std::optional<RemeshResult> coarse;
  if (!task.narrow) coarse = remesh_of_stand_in(task.input, options, coarser);
  if (coarse && (was_interrupted(options) || is_remnant(coarse->mesh)) && options.fixed.empty())
    return on_surface(std::move(*coarse), task.input, shared.sizing, options);
  std::optional<SplitSurface> apart;
  const double near_itself = coarse ? 0 : share_near_itself(task, shared, options);
  if (!coarse) apart = surface_apart(task, shared, options, near_itself);
  if (task.only_apart && !apart) return result;
  const bool is_dense = !coarse && task.of_input && may_be_coarser(task.input, *task.of_input, options);
  const auto on_coarser = [&] { return remesh_of_coarser(task.input, shared.sizing, options, coarser); };
  if (apart && is_dense)
    if (auto made = on_coarser()) return std::move(*made);
  const bool may_stand_in = is_dense && !apart;  // else that was tried
  if (apart && !apart->h.empty()) shared.sizing = Sizing(apart->mesh, apart->h);
  const geom::TriMesh& surface = apart ? apart->mesh : task.surface();
  const WantedType type(surface, branch_edges(shared.features));
  const bool may_part = options.sheets == Sheets::automatic && !task.start && !apart;
  std::optional<RemeshResult> early;
  if (may_part && near_itself > some_near_itself && !task.same)
    early = glanced_at(task, shared, type, options);
  if (early && early->cut_short) return (is_dense ? on_coarser() : std::nullopt).value_or(std::move(*early));
  auto distributed = std::make_unique<SurfaceDomain>(
      coarse      ? settled_samples(surface, shared, *coarse, options, result)
      : task.same ? same_samples(surface, shared, *task.same, options, result)
                  : distributed_samples(surface, shared, task.start, options, result));
  if (early && was_interrupted(options) && result.optimization.moves < early->optimization.moves) {
    distributed = std::make_unique<SurfaceDomain>(same_samples(surface, shared, *early, options, result));
    result.optimization.reason = StopReason::interrupted;
  }
  if (!has_triangles(*distributed)) {
    const Sizing sizing = distributed->sizing();
    const std::vector<SurfaceSample> all = samples_of(*distributed);
    auto made = without_diagram({task, shared, sizing, apart ? &*apart : nullptr, type, nullptr, all},
                                options, result);
    if (made) return std::move(*made);
  }
  std::unique_ptr<SurfaceDomain> samples =
      with_room(std::move(distributed), shared, type, options, result, may_part || may_stand_in);
  if ((may_part || may_stand_in) && result.thin_parts.faults_before > 0) {
    if (may_stand_in)
      if (auto made = on_coarser()) return std::move(*made);
    if (may_part && has_near_sheets(task, shared, options) && !was_interrupted(options))
      return only_samples(*samples, std::move(result));
    samples = with_room(std::move(samples), shared, type, options, result);
  }
  if (was_interrupted(options) && task.start && task.start->mesh.num_facets() > 0) throw geom::Interrupted();
  if (task.rival && is_left_behind(result.thin_parts, options.num_samples, *task.rival)) return {};
  const bool came_with_faults = coarse && is_at_fault(*coarse);
  result = remesh_of(std::move(samples), {task, shared, apart ? &*apart : nullptr, type, came_with_faults},
                     options, std::move(result));
  if (apart) return_to(*apart, result);
  if (!coarse || is_fine(result) || !options.fixed.empty()) return result;
  RemeshResult other = on_surface(std::move(*coarse), task.input, shared.sizing, options);
  return is_better(other, result) ? other : result;
}

}  // namespace

RemeshResult attempted_remesh(const geom::TriMesh& surface, const FeatureChoice& choice,
                              const RemeshOptions& options, const Beginning& begin,
                              const RemeshFunction& coarser) {
  const SizingFor plain = part_sizing(surface, choice.features, options);
  const std::optional<NarrowSurface> narrow =
      helpful_narrow_surface(surface, choice.features, plain, options);
  RemeshTask task{surface, plain, nullptr, choice.features, begin.only_apart, begin.start, begin.rival};
  if (!begin.start && !begin.rival && !begin.same && !begin.only_apart) task.of_input = &choice.features;
  RemeshResult result;
  if (narrow) {
    task.narrow = &*narrow;
    task.features = split_features(choice.features, surface, narrow->split);
    result = remesh_task(task, options, coarser);
    return_to(narrow->split, result);
  } else {
    task.same = begin.same;  // else its samples are on another mesh
    result = remesh_task(task, options, coarser);
  }
  if (!result.stood_in || result.given_up.empty()) {  // else something was on the coarser surface
    result.given_up = choice.given_up;
    result.features_missed = choice.are_missed;
  }
  result.collapsed_curves = choice.collapsed;
  if (!result.stood_in) result.kept = std::make_shared<const Features>(choice.features);
  result.strong_only = options.strong_creases_only;
  return result;
}

}  // namespace fpo
