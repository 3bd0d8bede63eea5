#include "fpo/remesh/harmful_creases.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fpo/features/split_features.h"
#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/crease_cuts.h"
#include "fpo/remesh/harmful_parts.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/return_to.h"
#include "geom/check.h"
#include "geom/repair/intersections.h"

namespace fpo {
namespace {

constexpr std::size_t few_faults = 12;
constexpr double most_lacking = 0.9;  // of what was lacking before
constexpr double most_lacking_otherwise = 1.0 / 3;
constexpr double least_worth = 0.5;  // of what angles had to be worth for what is given up

/// Of another type in a few places.
bool has_few_faults(const RemeshResult& result) {
  return result.mesh.num_facets() > 0 && !result.advice.places.empty() &&
         std::max(result.advice.places.size(), result.thin_parts.faults_after) <= few_faults;
}

bool may_have_harmful_creases(const RemeshResult& result) {
  return result.kept && !result.cut && (result.type.ok() || has_few_faults(result)) && !result.by_collapses &&
         result.crease_curves > 0 && result.least_length == 0;
}

/// What is given up, for users.
struct GivenUp {
  std::size_t curves = 0, in_part = 0;
  bool for_faults = false;
  void add(const std::vector<CreasePart>& parts) {
    curves += parts.size();
    in_part += static_cast<std::size_t>(std::ranges::count(parts, false, &CreasePart::is_whole));
  }
};

/// With a choice of features; of so many curves.
std::string told(const FeatureChoice& choice, const GivenUp& given_up, std::size_t of) {
  std::string why;
  if (given_up.in_part == given_up.curves) why = ", in part";
  if (given_up.in_part > 0 && given_up.in_part < given_up.curves)
    why = ", " + std::to_string(given_up.in_part) + " of them in part";
  why += std::string(", for ") + (given_up.for_faults ? "faults and " : "") + "small angles beside them";
  const std::string curves = std::to_string(given_up.curves);
  if (!choice.given_up.empty()) return choice.given_up + "; " + curves + " more" + why;
  return "creases given up: " + curves + " of " + std::to_string(of) + " curves" + why +
         "; --features 30 keeps them";
}

/// What a remesh lacks that comes instead of another: in angles and, where that one does not cross itself, in
/// facets that cross each other, or fold back upon others at a tip, an angle of nothing for two.
double lacking_instead(const RemeshResult& is, const RemeshResult& was) {
  const double in_angles = lacking_in_angles(is.mesh);
  const std::size_t crossing = geom::self_intersections(is.mesh).pairs;
  if (crossing == 0 || geom::self_intersections(was.mesh).pairs > 0) return in_angles;
  return in_angles + static_cast<double>(crossing);
}

/// Are angles so much better, in the end? Creases are of worth, too. A mesh that is no dual of its samples
/// any more (last_resort.h) comes instead of one that is only if it lacks a third as much.
bool is_worth_it(const RemeshResult& fewer, const RemeshResult& result,
                 const std::vector<CreasePart>& given_up) {
  const RemeshResult &is = as_it_will_be(fewer), &was = as_it_will_be(result);
  if (is.mesh.num_facets() == 0 || !is_better(is, was)) return false;
  if (!was.type.ok()) return true;
  const double lacked = lacking_in_angles(was.mesh), lacks = lacking_instead(is, was);
  const bool is_dual = fewer.type.ok() || !result.type.ok();
  if (!is_dual && lacks > most_lacking_otherwise * lacked) return false;
  double strength = 0;
  for (const CreasePart& part : given_up) strength += part.strength;
  return lacks <= most_lacking * lacked && worth_of_angles(lacked - lacks) >= least_worth * strength;
}

/// Could it be, if all goes well?
bool may_be_worth_it(const std::vector<CreasePart>& parts, const RemeshResult& result) {
  double lacking = 0;
  for (const CreasePart& part : parts) lacking += part.lacking;
  return lacking >= (1 - most_lacking) * lacking_in_angles(result.mesh);
}

void append(const std::vector<FeatureEdge>& edges, std::vector<FeatureEdge>& to) {
  to.insert(to.end(), edges.begin(), edges.end());
}

/// None if it is refused as well.
template <class Remesh>
std::optional<RemeshResult> unless_refused(const Remesh& remesh) try {
  return remesh();
} catch (const geom::InputError&) {
  return {};
}

/// As that one was made, but where sheets were together they may be set apart: with fewer creases they may do
/// harm that they did not do before.
RemeshOptions in_this_way(const RemeshResult& result, const RemeshOptions& options) {
  RemeshOptions how = in_the_way_of(result, options);
  if (!result.has_levels) how.sheets = options.sheets;
  return how;
}

/// What has come of giving up creases so far.
struct Fewer {
  RemeshResult result;
  std::size_t num_curves;               ///< before
  std::vector<FeatureEdge> unmarked{};  ///< for it
  GivenUp given_up{};
};

/// How often the surface is remeshed.
struct Patience {
  int most_times;
  bool for_other_types;  ///< go on where one is lost: such remeshes take longest
};
constexpr Patience as_it_is{3, true}, on_cut{2, false};

/// As long as that helps.
void give_up_parts(const geom::TriMesh& surface, const RemeshOptions& options, const Patience& patience,
                   const RemeshWithFeatures& remesh, Fewer& so_far) {
  RemeshResult& result = so_far.result;
  const double spacing = even_spacing(surface, options);
  RemeshOptions fewer = options;
  fewer.strong_creases_only = result.strong_only;
  std::vector<FeatureEdge> spared = options.features->marked;  // somebody asked for these
  const auto harmful_in = [&](const RemeshResult& of) {
    const RemeshWithCurves remeshed{of.mesh, of.feature_samples, of.advice.places};
    return harmful_parts(surface, *of.kept, remeshed, {spacing, spared});
  };
  std::vector<CreasePart> harmful = harmful_in(result);
  bool has_added = false;  // what others do harm without these
  for (int attempt = 0; attempt < patience.most_times && !harmful.empty(); ++attempt) {
    if (interrupted(options.optimize.interrupted) || !may_be_worth_it(harmful, result)) break;
    std::vector<FeatureEdge> unmarked = so_far.unmarked;
    for (const CreasePart& part : harmful) append(part.edges, unmarked);
    RemeshOptions how = fewer;
    append(unmarked, how.features->unmarked);
    const FeatureChoice choice = chosen_features(surface, how);
    std::optional<RemeshResult> other;
    if (has_creases(choice.features))
      other = unless_refused([&] { return remesh(surface, choice, in_this_way(result, how)); });
    if (other && is_worth_it(*other, result, harmful)) {
      so_far.given_up.for_faults |= !result.type.ok();
      so_far.given_up.add(harmful);
      so_far.unmarked = std::move(unmarked);
      result = std::move(*other);
      result.given_up = told(choice, so_far.given_up, so_far.num_curves);
      result.features_missed = true;
      if (!may_have_harmful_creases(result)) break;
      harmful = harmful_in(result);
      continue;
    }
    if (!patience.for_other_types && other && !other->type.ok() && result.type.ok()) break;
    const bool may_add = !has_added && other && !other->type.ok() && may_have_harmful_creases(*other);
    if (const std::vector<CreasePart> more = may_add ? harmful_in(*other) : std::vector<CreasePart>();
        !more.empty()) {
      harmful.insert(harmful.end(), more.begin(), more.end());
      has_added = true;
    } else if (harmful.size() > 1) {
      harmful.resize(harmful.size() / 2);
    } else {
      append(harmful.front().edges, spared);
      harmful = harmful_in(result);
    }
  }
}

/// The same with long edges cut, if there are any.
void give_up_parts_of_long_edges(const geom::TriMesh& surface, const RemeshOptions& options,
                                 const RemeshWithFeatures& remesh, Fewer& so_far) {
  const RemeshResult& result = so_far.result;
  const RemeshWithCurves remeshed{result.mesh, result.feature_samples, result.advice.places};
  const std::vector<EdgeCut> cuts =
      crease_cuts(surface, *result.kept, remeshed, even_spacing(surface, options));
  if (cuts.empty()) return;
  const auto cut = std::make_shared<const SplitSurface>(with_cut_edges(surface, cuts));
  RemeshOptions there = options;
  if (!there.rho.empty()) there.rho = on_cut_edges(surface, *cut, there.rho);
  Fewer still_fewer = so_far;
  still_fewer.result.kept = std::make_shared<const Features>(split_features(*result.kept, surface, *cut));
  give_up_parts(cut->mesh, there, on_cut, remesh, still_fewer);
  if (still_fewer.given_up.curves == so_far.given_up.curves) return;
  so_far = std::move(still_fewer);
  return_to(surface, cut, so_far.result);
}

}  // namespace

RemeshResult without_harmful_creases(const geom::TriMesh& surface, const RemeshOptions& options,
                                     RemeshResult result, const RemeshWithFeatures& remesh) {
  if (!may_have_harmful_creases(result) || (result.type.ok() && !options.optimize_angles)) return result;
  const std::size_t num_curves = result.kept->curves.size();
  Fewer fewer{std::move(result), num_curves};
  give_up_parts(surface, options, as_it_is, remesh, fewer);
  if (options.features->marked.empty() && may_have_harmful_creases(fewer.result) &&
      lacking_in_angles(fewer.result.mesh) > 0 && !interrupted(options.optimize.interrupted))
    give_up_parts_of_long_edges(surface, options, remesh, fewer);
  return std::move(fewer.result);
}

}  // namespace fpo
