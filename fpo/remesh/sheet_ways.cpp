#include "fpo/remesh/sheet_ways.h"

#include <array>
#include <utility>

#include "fpo/remesh/attempt.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/refusal.h"
#include "fpo/remesh/remesh_surface.h"
#include "fpo/remesh/stand_in_remesh.h"
#include "fpo/remesh/unless_interrupted.h"

namespace fpo {
namespace {

constexpr std::array<double, 2> softer = {0.3, 1};  // least lengths in even spacings, where n is too small

RemeshResult remesh_with(const geom::TriMesh& surface, const FeatureChoice& choice,
                         const RemeshOptions& options, const Beginning& begin = {}) {
  return attempted_remesh(surface, choice, options, begin, remesh_surface);
}

bool has_only_samples(const RemeshResult& result) {
  return result.mesh.num_facets() == 0 && !result.samples.empty();
}

/// Has another mesh that is all that is wanted: nothing else is tried.
bool is_saved(const RemeshResult& result) {
  return has_wanted_angles(as_it_will_be(result)) && !has_wanted_angles(result);
}

/// Takes the other one if there is one, and it is better in the end.
bool take_if_better(std::optional<RemeshResult> other, RemeshResult& best) {
  if (!other || other->mesh.num_facets() == 0 || !is_better_in_the_end(*other, best)) return false;
  best = std::move(*other);
  return true;
}

/// The ways to remesh a surface with these curves, one after the other, and the best result so far.
struct Ways {
  const geom::TriMesh& surface;
  const FeatureChoice& choice;
  const RemeshOptions& options;
  RemeshResult best;

  RemeshResult go(const RemeshOptions& otherwise, const Beginning& begin) const {
    return remesh_with(surface, choice, otherwise, begin);
  }
  /// The same, nothing if it is interrupted.
  std::optional<RemeshResult> go_if_time(const RemeshOptions& otherwise, const Beginning& begin) const {
    return unless_interrupted(options, [&] { return go(otherwise, begin); });
  }
  void attempt(const RemeshOptions& otherwise, Beginning begin) {
    if (interrupted(options)) return;
    begin.rival = &best;
    take_if_better(go_if_time(otherwise, begin), best);
  }
};

RemeshOptions with_sheets(const RemeshOptions& options, Sheets sheets) {
  RemeshOptions otherwise = options;
  otherwise.sheets = sheets;
  return otherwise;
}

const RemeshResult* if_unmoved(const RemeshResult& begun) {
  return begun.protection.moved == 0 ? &begun : nullptr;
}

/// As if it had not been cut short: what that led to is not all that is wanted.
void go_to_the_end(Ways& ways) {
  RemeshOptions whole = ways.options;
  whole.may_cut_short = false;
  std::optional<RemeshResult> begun = ways.go_if_time(whole, {});
  if (!begun || !has_only_samples(*begun)) {
    take_if_better(std::move(begun), ways.best);
    return;
  }
  ways.attempt(with_sheets(ways.options, Sheets::apart), {&*begun, true});
  if (!ways.best.type.ok())
    ways.attempt(with_sheets(ways.options, Sheets::together), {.same = if_unmoved(*begun)});
}

}  // namespace

bool may_drop_creases(const RemeshOptions& options) {
  return options.features && options.features->yielding && options.method == Method::fpo;
}

bool is_slow_with_creases(const geom::TriMesh& surface, const RemeshResult& result,
                          const RemeshOptions& options) {
  return may_drop_creases(options) && options.sizing == SizingKind::uniform && result.crease_curves > 0 &&
         (!is_useful(result) || has_many_small_angles(result)) && may_be_coarser(surface, {}, options);
}

bool should_drop_creases(const geom::TriMesh& surface, const RemeshResult& result,
                         const RemeshOptions& options) {
  return is_slow_with_creases(surface, result, options) ||
         (may_drop_creases(options) && options.sizing == SizingKind::uniform && is_spoilt_by_creases(result));
}

FirstWay first_way(const geom::TriMesh& surface, const FeatureChoice& choice, const RemeshOptions& options) {
  FirstWay first{remesh_with(surface, choice, options)};
  if (!has_only_samples(first.result)) return first;
  first.begun = std::move(first.result);
  first.result = remesh_with(surface, choice, with_sheets(options, Sheets::apart), {&*first.begun, true});
  return first;
}

std::optional<RemeshResult> first_way_if_time(const geom::TriMesh& surface, const FeatureChoice& choice,
                                              const RemeshOptions& options) {
  return unless_interrupted(options, [&] { return first_way(surface, choice, options).result; });
}

namespace {

/// Sheets were set apart: other ways where that has not led to what is wanted.
void go_on_from_apart(Ways& ways, const RemeshResult& begun) {
  RemeshResult& best = ways.best;
  const RemeshOptions together = with_sheets(ways.options, Sheets::together);
  const RemeshResult* const same = begun.cut_short ? nullptr : if_unmoved(begun);
  if (!best.has_levels) {
    std::optional<RemeshResult> other = ways.go_if_time(together, {.same = same});
    best = other ? std::move(*other) : ways.go(together, {&begun});
    return;
  }
  const bool hopeless = (is_hopeless(best) || is_in_ruins(best)) && is_hopeless(begun);
  const bool may_have_type =
      !best.type.ok() && !hopeless && !should_drop_creases(ways.surface, best, ways.options);
  if (begun.cut_short && (may_have_type || has_few_small_angles(best)))
    go_to_the_end(ways);
  else if (may_have_type)
    ways.attempt(together, {.same = same});
}

/// All of remesh_sheets() with staggered samples.
RemeshResult remesh_with_sheets(const geom::TriMesh& surface, const FeatureChoice& choice,
                                const RemeshOptions& options, std::optional<FirstWay> first) {
  if (!first) first = first_way(surface, choice, options);
  Ways ways{surface, choice, options, std::move(first->result)};
  RemeshResult& best = ways.best;
  const RemeshOptions together = with_sheets(options, Sheets::together);
  const bool parted = first->begun.has_value();
  if (parted) go_on_from_apart(ways, *first->begun);
  if (options.sheets != Sheets::automatic || options.method != Method::fpo || is_fine(best) ||
      is_saved(best) || best.stood_in ||  // all of this was tried on what stood in
      should_drop_creases(surface, best, options) || (is_remnant(best.mesh) && !may_be_faced(best)))
    return best;
  const bool parted_at_once = best.has_levels && !parted;
  if (parted_at_once && !is_useful(best)) ways.attempt(together, {});
  if ((is_hopeless(best) && !may_be_faced(best)) ||
      (!best.type.ok() && geom::topology(surface).nonmanifold_edges > 0))
    return best;
  if (!parted && !parted_at_once && !is_in_ruins(best))
    ways.attempt(with_sheets(options, Sheets::apart), {&best, true});
  if (best.broken_feature_edges > 0) {
    RemeshOptions facing = in_the_way_of(best, options);
    facing.facing_samples = true;
    ways.attempt(facing, {&best});
  }
  if (may_have_room(best)) {
    RemeshOptions longer = in_the_way_of(best, options);
    longer.rounds_for_thin_parts *= 2;
    ways.attempt(longer, {&best});
  }
  for (const double least : softer) {
    if (best.type.ok() || is_in_ruins(best) || options.sizing == SizingKind::uniform ||
        options.limits.smallest >= least)
      break;
    RemeshOptions even = with_sheets(options, best.has_levels ? Sheets::apart : Sheets::together);
    even.limits.smallest = least;
    ways.attempt(even, {});
    if (best.type.ok()) best.least_length = least;
  }
  return best;
}

}  // namespace

bool take_if_better_with(const geom::TriMesh& surface, const FeatureChoice& choice,
                         const RemeshOptions& options, RemeshResult& best) {
  const bool is_first_better = take_if_better(
      unless_interrupted(
          options,
          [&] { return remesh_with(surface, choice, in_the_way_of(best, options), {.rival = &best}); }),
      best);
  if (!is_first_better || is_fine(best) || options.sheets != Sheets::automatic || interrupted(options))
    return is_first_better;
  take_if_better(
      unless_interrupted(options, [&] { return remesh_with_sheets(surface, choice, options, {}); }), best);
  return true;
}

RemeshResult remesh_sheets(const geom::TriMesh& surface, const FeatureChoice& choice,
                           const RemeshOptions& options, std::optional<FirstWay> first) {
  RemeshResult best = remesh_with_sheets(surface, choice, options, std::move(first));
  if (!is_undone_by_staggering(best) || options.sheets != Sheets::automatic || best.stood_in ||
      should_drop_creases(surface, best, options) || interrupted(options))
    return best;
  RemeshOptions side_by_side = options;
  side_by_side.staggered_samples = false;
  take_if_better_with(surface, choice, side_by_side, best);
  return best;
}

}  // namespace fpo
