#include "fpo/remesh/pipeline.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "fpo/features/weak_curves.h"
#include "fpo/interruption.h"
#include "fpo/remesh/angles_at_curves.h"
#include "fpo/remesh/attempt.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/feature_bound.h"
#include "fpo/remesh/harmful_creases.h"
#include "fpo/remesh/last_resort.h"
#include "fpo/remesh/noise.h"
#include "fpo/remesh/refusal.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/stand_in.h"
#include "fpo/remesh/stand_in_remesh.h"
#include "fpo/remesh/trimmed_remesh.h"
#include "fpo/remesh/unit_box.h"
#include "geom/check.h"

namespace fpo {
namespace {

constexpr double smallest_beside_curves = 1.0 / 3;  // in spacings: wanted length
constexpr double most_on_curves = 0.5;              // of the samples
constexpr double nearly_all = 0.95;                 // of the creases' length
constexpr std::array<double, 2> softer = {0.3, 1};  // least lengths in even spacings, where n is too small
constexpr std::size_t triangles_for_one_flaw = 100;
constexpr double most_lacking_without = 1.0 / 3;  // in angles, of what is with creases

RemeshResult remesh_smoothed_or_not(const geom::TriMesh& surface, const RemeshOptions& options);

/// Another result where there is one already: nothing if it is interrupted.
template <class Make>
std::optional<RemeshResult> unless_interrupted(const RemeshOptions& options, Make make) try {
  RemeshResult result = make();
  if (fpo::interrupted(options.optimize.interrupted)) return {};
  return result;
} catch (const geom::Interrupted&) {
  return {};
}

bool interrupted(const RemeshOptions& options) { return fpo::interrupted(options.optimize.interrupted); }

RemeshResult remesh_with(const geom::TriMesh& surface, const FeatureChoice& choice,
                         const RemeshOptions& options, const Beginning& begin = {}) {
  return attempted_remesh(surface, choice, options, begin, remesh_smoothed_or_not);
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

/// Creases that nobody asked for may be given up for what harm they do.
bool may_drop_creases(const RemeshOptions& options) {
  return options.features && options.features->yielding && options.method == Method::fpo;
}

/// On a dense surface each way with creases is made on the surface itself, and one without can be made on a
/// coarser one (stand_in_remesh.h), by measurement several times as fast: if the first is of no use, or of
/// little, no other with creases is tried.
bool is_slow_with_creases(const geom::TriMesh& surface, const RemeshResult& result,
                          const RemeshOptions& options) {
  return may_drop_creases(options) && options.sizing == SizingKind::uniform && result.crease_curves > 0 &&
         (!is_useful(result) || has_many_small_angles(result)) && may_be_coarser(surface, {}, options);
}

/// All creases that are kept are dropped at once, before other ways with them are tried: by measurement these
/// take minutes and end at fault. Not if lengths may differ: then smaller triangles somewhere may help.
bool should_drop_creases(const geom::TriMesh& surface, const RemeshResult& result,
                         const RemeshOptions& options) {
  return is_slow_with_creases(surface, result, options) ||
         (may_drop_creases(options) && options.sizing == SizingKind::uniform && is_spoilt_by_creases(result));
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

/// The first way, and what it led to at first if that was only samples, at fault for sheets near each other:
/// these are set apart then.
struct FirstWay {
  RemeshResult result;
  std::optional<RemeshResult> begun{};
};

FirstWay first_way(const geom::TriMesh& surface, const FeatureChoice& choice, const RemeshOptions& options) {
  FirstWay first{remesh_with(surface, choice, options)};
  if (!has_only_samples(first.result)) return first;
  first.begun = std::move(first.result);
  first.result = remesh_with(surface, choice, with_sheets(options, Sheets::apart), {&*first.begun, true});
  return first;
}

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

/// Sheets that are left to us are together unless they are near each other nearly everywhere, or that does
/// harm and being apart helps. Samples of close curves face each other if edges of curves are lost else.
/// Nothing of that where creases that may be dropped spoil it all, nor where the remesh is of another type
/// and the input has edges of more than two facets: most such are faulty all over, and each way is as slow.
/// `first`: what the first way leads to, if that is known.
RemeshResult remesh_with_sheets(const geom::TriMesh& surface, const FeatureChoice& choice,
                                const RemeshOptions& options, std::optional<FirstWay> first = {}) {
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

/// With other samples on curves than the best one has: it is taken if it is better. Each way costs as much.
/// By measurement (96 public meshes: no type was lost by it) the way in which the best one was made tells: if
/// it does not help, others are not tried. If it does, all are, that one once more.
bool take_if_better_with(const geom::TriMesh& surface, const FeatureChoice& choice,
                         const RemeshOptions& options, RemeshResult& best) {
  const bool is_first_better = take_if_better(
      unless_interrupted(
          options,
          [&] { return remesh_with(surface, choice, in_the_way_of(best, options), {.rival = &best}); }),
      best);
  if (!is_first_better || is_fine(best) || options.sheets != Sheets::automatic || interrupted(options))
    return is_first_better;
  take_if_better(unless_interrupted(options, [&] { return remesh_with_sheets(surface, choice, options); }),
                 best);
  return true;
}

/// The same, and once more without staggered samples where these may have spoilt it; the better one.
RemeshResult remesh_sheets(const geom::TriMesh& surface, const FeatureChoice& choice,
                           const RemeshOptions& options, std::optional<FirstWay> first = {}) {
  RemeshResult best = remesh_with_sheets(surface, choice, options, std::move(first));
  if (!is_undone_by_staggering(best) || options.sheets != Sheets::automatic || best.stood_in ||
      should_drop_creases(surface, best, options) || interrupted(options))
    return best;
  RemeshOptions side_by_side = options;
  side_by_side.staggered_samples = false;
  take_if_better_with(surface, choice, side_by_side, best);
  return best;
}

RemeshOptions without_creases(RemeshOptions options) {
  options.features->crease_angle = options.features->weak_crease_angle = 180;
  return options;
}

/// What there is already, and whether the strongest creases alone are not to be tried: they were, or the
/// surface is slow with creases.
struct WithCreases {
  RemeshResult result;
  bool strong_settled = false;
  std::optional<RemeshResult> without;  ///< any creases, if that is known
  bool had_many_small_angles = false;   ///< before some creases were given up for it
};

std::optional<RemeshResult> remesh_without_creases(const geom::TriMesh& surface,
                                                   const RemeshOptions& options) {
  const RemeshOptions without = without_creases(options);
  const FeatureChoice borders = chosen_features(surface, without);
  return unless_interrupted(options, [&] { return remesh_sheets(surface, borders, without); });
}

/// That, for what creases did to another.
RemeshResult with_creases_dropped(RemeshResult without, const std::string& harm) {
  without.given_up = "creases dropped: " + harm + "; --features 45 keeps them";
  without.features_missed = true;
  return without;
}

/// Where there are many still.
bool spares_most_small_angles(const RemeshResult& without, const RemeshResult& with) {
  return has_many_small_angles(with) &&
         lacking_in_angles(without.mesh) <= most_lacking_without * lacking_in_angles(with.mesh);
}

/// Only the strongest creases, if that is of more use than all of them; if all are useless perhaps none. None
/// as well if that alone has no small angles, or few, where there are many.
RemeshResult remesh_with_fewer_creases(const geom::TriMesh& surface, WithCreases with,
                                       const RemeshOptions& options) {
  RemeshResult result = std::move(with.result);
  const std::string harm = harm_of_creases(as_it_will_be(result));
  RemeshOptions fewer = options;
  fewer.strong_creases_only = true;
  const FeatureChoice strong = chosen_features(surface, fewer);
  if (!with.strong_settled && !strong.given_up.empty() && !strong.features.curves.empty()) {
    RemeshResult other = result;
    if (take_if_better_with(surface, strong, fewer, other) &&
        is_worth_creases(as_it_will_be(other), as_it_will_be(result))) {
      result = std::move(other);
      with.had_many_small_angles = has_many_small_angles(as_it_will_be(result));
    }
  }
  const auto is_useless_in_the_end = [&] { return is_useless(as_it_will_be(result)); };
  if ((!is_useless_in_the_end() && !with.had_many_small_angles) || interrupted(options)) return result;
  std::optional<RemeshResult> other = std::move(with.without);
  if (!other) other = remesh_without_creases(surface, options);
  if (other && is_worth_creases(as_it_will_be(*other), as_it_will_be(result)) &&
      (is_useless_in_the_end() || has_wanted_angles(*other) ||
       spares_most_small_angles(as_it_will_be(*other), as_it_will_be(result))) &&
      take_if_better(std::move(other), result))
    return with_creases_dropped(std::move(result), harm);
  return result;
}

/// Whether there are creases without room for triangles between, if nobody asked for them.
bool has_crowded_creases(const geom::TriMesh& surface, const Features& features,
                         const RemeshOptions& options) {
  if (!may_drop_creases(options) || options.strong_creases_only || features.curves.empty()) return false;
  const SeenCurves seen = seen_curves(surface, features, even_spacing(surface, options));
  return !weakest_curves(seen, {.only_crowded = true}).empty();
}

double length_of(const geom::TriMesh& surface, const Features& features) {
  double length = 0;
  for (const FeatureCurve& curve : features.curves) length += length_of(surface, curve);
  return length;
}

/// A remesh with those creases alone that have room.
struct WithRoom {
  RemeshResult result;
  double share;  ///< of the length of all
};

/// Those, if there are some, and smaller triangles between are no help or would be smaller than a third of
/// the spacing.
std::optional<FeatureChoice> creases_with_room(const geom::TriMesh& surface, const Features& all,
                                               const RemeshOptions& options) {
  const auto narrow = helpful_narrow_surface(surface, all, part_sizing(surface, all, options), options);
  if (narrow && std::ranges::min(narrow->lengths) >= smallest_beside_curves * even_spacing(surface, options))
    return {};
  RemeshOptions fewer = options;
  fewer.strong_creases_only = true;
  FeatureChoice strong = chosen_features(surface, fewer);
  if (strong.given_up.empty() || strong.features.curves.empty()) return {};
  return strong;
}

/// Is it settled by the creases that have room that others are not to be tried with them? These would take
/// most samples, or be hardly any where angles are useless, or add to ruins that are not those of bars.
bool settles_creases(const WithRoom& with_room, const geom::TriMesh& surface, const Features& all,
                     const RemeshOptions& options) {
  const RemeshResult& result = with_room.result;
  const double most = even_spacing(surface, options) * static_cast<double>(options.num_samples);
  if (result.type.ok())
    return (with_room.share > nearly_all && !is_useful(result)) ||
           length_of(surface, all) > most_on_curves * most;
  return should_drop_creases(surface, result, options) || (is_in_ruins(result) && !may_be_faced(result));
}

/// Without creases, if the first way with them leads to another type and many small angles. Other ways with
/// them come after that, for each costs as much.
std::optional<RemeshResult> seen_without_creases(const geom::TriMesh& surface, const RemeshResult& first,
                                                 const RemeshOptions& options) {
  if (!may_drop_creases(options) || options.sizing != SizingKind::uniform || first.type.ok() ||
      !has_many_small_angles(first) || is_useful(as_it_will_be(first)) || interrupted(options) ||
      geom::topology(surface).nonmanifold_edges > 0)
    return {};
  return remesh_without_creases(surface, options);
}

/// Without those creases beside which angles are small, if nobody asked for them.
RemeshResult with_good_creases(const geom::TriMesh& surface, RemeshResult result,
                               const RemeshOptions& options) {
  if (!may_drop_creases(options)) return result;
  return without_harmful_creases(
      surface, options, std::move(result),
      [&](const geom::TriMesh& of, const FeatureChoice& choice, const RemeshOptions& how) {
        return unless_interrupted(options, [&] { return first_way(of, choice, how).result; });
      });
}

/// The same, where the first way leads to another type, if hardly any flaw is left then: other ways with the
/// same creases take longer (on two public parts, eight such ways of three to fifteen seconds, none of which
/// had the type).
std::optional<RemeshResult> with_good_creases_at_once(const geom::TriMesh& surface, const RemeshResult& first,
                                                      const RemeshOptions& options) {
  if (first.type.ok() || is_slow_with_creases(surface, first, options) || interrupted(options)) return {};
  RemeshResult good = with_good_creases(surface, first, options);
  const std::size_t flaws = good.measures.angles_below_30 + good.broken_feature_edges;
  if (!is_useful(good) || triangles_for_one_flaw * flaws > good.mesh.num_facets()) return {};
  return good;
}

/// Creases that nobody asked for are kept unless that alone does harm. Where they have no room, those that
/// have are tried first.
RemeshResult remesh_with_useful_creases(const geom::TriMesh& surface, const RemeshOptions& options) {
  const FeatureChoice all = chosen_features(surface, options);
  const bool crowded = has_crowded_creases(surface, all.features, options);
  std::optional<FeatureChoice> roomy;
  if (crowded) roomy = creases_with_room(surface, all.features, options);
  RemeshOptions how = options;
  how.strong_creases_only |= roomy.has_value();
  const FeatureChoice& chosen = roomy ? *roomy : all;
  FirstWay first = first_way(surface, chosen, how);
  std::optional<RemeshResult> without = seen_without_creases(surface, first.result, options);
  if (without && is_instead_of(first.result, as_it_will_be(*without)))
    return with_creases_dropped(std::move(*without), harm_of_creases(as_it_will_be(first.result)));
  if (auto good = with_good_creases_at_once(surface, first.result, how)) return std::move(*good);
  RemeshResult chosen_ones = remesh_sheets(surface, chosen, how, std::move(first));
  std::optional<WithRoom> with_room;
  if (roomy)
    with_room = {std::move(chosen_ones),
                 length_of(surface, chosen.features) / length_of(surface, all.features)};
  if (with_room &&
      (has_wanted_angles(with_room->result) || with_room->result.made_coarser || interrupted(options)))
    return with_good_creases(surface, std::move(with_room->result), options);
  WithCreases with{{}, with_room.has_value(), std::move(without)};
  RemeshResult& result = with.result;
  if (with_room) {
    const bool settled = settles_creases(*with_room, surface, all.features, options);
    result = std::move(with_room->result);
    if (!settled) take_if_better_with(surface, all, options, result);
  } else {
    result = std::move(chosen_ones);
  }
  with.had_many_small_angles = has_many_small_angles(as_it_will_be(result));
  if (result.type.ok() && !is_slow_with_creases(surface, result, options))
    result = with_good_creases(surface, std::move(result), options);
  if (result.crease_curves == 0 || !may_drop_creases(options) || result.stood_in || interrupted(options) ||
      geom::topology(surface).nonmanifold_edges > 0 || has_wanted_angles(as_it_will_be(result)) ||
      (is_useful(as_it_will_be(result)) && !crowded && !with.had_many_small_angles))
    return std::move(result);
  const bool is_slow = is_slow_with_creases(surface, result, options);
  with.strong_settled |= is_slow;
  const bool has_few_on_curves = 2 * result.feature_samples < options.num_samples;
  const bool has_other_ways = may_be_smoothed(options) && is_folded(surface);
  if ((is_hopeless(result) || is_in_ruins(result)) && (has_few_on_curves || has_other_ways) && !is_slow)
    return std::move(result);
  return remesh_with_fewer_creases(surface, std::move(with), options);
}

/// The same, or without any if with them it is refused.
RemeshResult remesh_with_creases_or_not(const geom::TriMesh& surface, const RemeshOptions& options) try {
  return remesh_with_useful_creases(surface, options);
} catch (const geom::InputError& refusal) {
  if (!may_drop_creases(options)) throw;
  const auto curves = chosen_features(surface, options).features.curves;
  const auto creases = std::ranges::count(curves, std::size_t{2}, &FeatureCurve::sheets);
  if (creases == 0) throw;
  const RemeshOptions without = without_creases(options);
  RemeshResult result = remesh_sheets(surface, chosen_features(surface, without), without);
  result.given_up = "creases dropped: with " + std::to_string(creases) + " curves kept " + refusal.what() +
                    "; --features 45 keeps them";
  result.features_missed = true;
  return result;
}

/// If it was made on a coarser surface, and has small angles, once more on this one: the better one.
RemeshResult remesh_coarser_or_not(const geom::TriMesh& surface, const RemeshOptions& options) {
  RemeshResult best = remesh_with_creases_or_not(surface, options);
  if (!best.made_coarser || has_wanted_angles(best) || interrupted(options)) return best;
  RemeshOptions itself = options;
  itself.coarse_for_all = false;
  try {
    std::optional<RemeshResult> other =
        unless_interrupted(options, [&] { return remesh_with_creases_or_not(surface, itself); });
    if (other && is_better(as_it_will_be(*other), as_it_will_be(best))) return std::move(*other);
  } catch (const geom::InputError&) {  // refused here: the other one stays
  }
  return best;
}

RemeshResult remesh_smoothed(const geom::TriMesh& surface, const RemeshOptions& options) {
  const geom::TriMesh smooth = smoothed(surface, options.num_samples);
  RemeshOptions there = options;
  there.keep_cells = false;
  return on_noise(or_last_resort(remesh_coarser_or_not(smooth, there)), smooth, surface, options);
}

/// On a smooth surface where this one is noise or, if it is folded, no remesh of it is of its type; or on
/// itself.
RemeshResult remesh_smoothed_or_not(const geom::TriMesh& surface, const RemeshOptions& options) {
  const bool may_be = may_be_smoothed(options);
  if (may_be && has_noise(surface, options.num_samples)) return remesh_smoothed(surface, options);
  const auto with_bound = [](const geom::TriMesh& of, const RemeshOptions& how) {
    RemeshResult made = or_last_resort(remesh_coarser_or_not(of, how));
    if (!interrupted(how)) made.feature_bound = feature_bound(of, how);
    return made;
  };
  RemeshResult result = remesh_trimmed_or_not(surface, options, with_bound);
  if (!may_be || (result.type.ok() && !result.by_collapses) || interrupted(options) || !is_folded(surface) ||
      geom::topology(surface).nonmanifold_edges > 0)
    return result;
  std::optional<RemeshResult> other =
      unless_interrupted(options, [&] { return remesh_smoothed(surface, options); });
  return other && other->type.ok() && is_better(*other, result) ? std::move(*other) : result;
}

/// And what is far from it. Lengths that were to be even are what was asked for, where they are less, too.
RemeshResult remesh_and_look(const geom::TriMesh& surface, const RemeshOptions& options) {
  RemeshResult result = remesh_smoothed_or_not(surface, options);
  VertexField wanted = result.sizing;
  if (options.sizing == SizingKind::uniform) {
    const double even = even_spacing(surface, options);
    for (double& h : wanted) h = std::max(h, even);
  }
  result.far_part = far_part(surface, wanted, result.mesh, result.samples);
  return result;
}

}  // namespace

RemeshResult remesh(const geom::TriMesh& input, const RemeshOptions& options) try {
  geom::require(options.num_samples > 0, "the number of samples must be at least 1");
  geom::require(options.disk_radius == 0 || options.sizing == SizingKind::uniform,
                "a radius of disks goes with uniform sizing only");
  return remesh_in_unit_box(input, options, remesh_and_look);
} catch (const geom::Bug& bug) {
  throw geom::Bug("seed " + std::to_string(options.seed) + ", " + bug.what());
}

}  // namespace fpo
