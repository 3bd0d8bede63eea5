#include "fpo/remesh/useful_creases.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fpo/features/weak_curves.h"
#include "fpo/remesh/angles_at_curves.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/harmful_creases.h"
#include "fpo/remesh/noise.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/sheet_ways.h"
#include "fpo/remesh/unless_interrupted.h"
#include "geom/mesh/trimesh.h"

namespace fpo {
namespace {

constexpr double smallest_beside_curves = 1.0 / 3;  // in spacings: wanted length
constexpr double most_on_curves = 0.5;              // of the samples
constexpr double nearly_all = 0.95;                 // of the creases' length
constexpr std::size_t triangles_for_one_flaw = 100;
constexpr double most_lacking_without = 1.0 / 3;  // in angles, of what is with creases

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

/// Is a remesh without creases taken instead of one with those that do least harm?
bool is_instead_of_fewer(const RemeshResult& without, const RemeshResult& with) {
  const RemeshResult &is = as_it_will_be(without), &was = as_it_will_be(with);
  if (without.mesh.num_facets() == 0 || !is_worth_creases(is, was)) return false;
  const bool spares_most = is.type.ok() && has_many_small_angles(was) &&
                           lacking_in_angles(is.mesh) <= most_lacking_without * lacking_in_angles(was.mesh);
  if (spares_most) return is_better(is, was);
  return (is_useless(was) || has_wanted_angles(without)) && is_better_in_the_end(without, with);
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
  return other && is_instead_of_fewer(*other, result) ? with_creases_dropped(std::move(*other), harm)
                                                      : result;
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
  return without_harmful_creases(surface, options, std::move(result), first_way_if_time);
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

}  // namespace

RemeshOptions without_creases(RemeshOptions options) {
  options.features->crease_angle = options.features->weak_crease_angle = 180;
  return options;
}

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
  WithCreases with{{}, roomy.has_value(), std::move(without)};
  RemeshResult& result = with.result;
  if (roomy) {
    WithRoom with_room{std::move(chosen_ones),
                       length_of(surface, chosen.features) / length_of(surface, all.features)};
    if (has_wanted_angles(with_room.result) || with_room.result.made_coarser || interrupted(options))
      return with_good_creases(surface, std::move(with_room.result), options);
    const bool settled = settles_creases(with_room, surface, all.features, options);
    result = std::move(with_room.result);
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
    return std::move(with.result);
  const bool is_slow = is_slow_with_creases(surface, result, options);
  with.strong_settled |= is_slow;
  const bool has_few_on_curves = 2 * result.feature_samples < options.num_samples;
  const bool has_other_ways = may_be_smoothed(options) && is_folded(surface);
  if ((is_hopeless(result) || is_in_ruins(result)) && (has_few_on_curves || has_other_ways) && !is_slow)
    return std::move(with.result);
  return remesh_with_fewer_creases(surface, std::move(with), options);
}

}  // namespace fpo
