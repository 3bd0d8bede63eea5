#include "fpo/remesh/harmful_creases.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fpo/features/weak_curves.h"
#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/harmful_curves.h"
#include "fpo/remesh/remesh_task.h"
#include "geom/check.h"

namespace fpo {
namespace {

constexpr int most_times = 3;
constexpr double most_lacking = 0.7;  // of what was lacking before

bool may_have_harmful_creases(const RemeshResult& result) {
  return result.kept && result.type.ok() && !result.by_collapses && result.crease_curves > 0 &&
         result.least_length == 0;
}

/// With a choice of features, for users.
std::string told(const FeatureChoice& choice, std::size_t more, std::size_t of) {
  const std::string number = std::to_string(more);
  if (!choice.given_up.empty()) return choice.given_up + "; " + number + " more for small angles beside them";
  return "creases given up: " + number + " of " + std::to_string(of) +
         " curves, for small angles beside them; --features 30 keeps them";
}

/// Are angles so much better? Creases are of worth, too.
bool is_worth_it(const RemeshResult& fewer, const RemeshResult& result) {
  return fewer.mesh.num_facets() > 0 && is_better(fewer, result) &&
         lacking_in_angles(fewer.mesh) <= most_lacking * lacking_in_angles(result.mesh);
}

/// None if it is refused as well.
std::optional<RemeshResult> unless_refused(const RemeshWithFeatures& remesh, const FeatureChoice& choice,
                                           const RemeshOptions& how) try {
  return remesh(choice, how);
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

}  // namespace

RemeshResult without_harmful_creases(const geom::TriMesh& surface, const RemeshOptions& options,
                                     RemeshResult result, const RemeshWithFeatures& remesh) {
  if (!may_have_harmful_creases(result)) return result;
  const std::size_t num_curves = result.kept->curves.size();
  const double spacing = even_spacing(surface, options);
  RemeshOptions fewer = options;
  fewer.strong_creases_only = result.strong_only;
  const auto find_harmful = [&] {
    return harmful_curves(surface, *result.kept, {result.mesh, result.feature_samples}, spacing);
  };
  std::vector<std::size_t> harmful = find_harmful();
  std::size_t number = 0;
  for (int attempt = 0; attempt < most_times && !harmful.empty(); ++attempt) {
    if (interrupted(options.optimize.interrupted)) break;
    RemeshOptions how = fewer;
    for (const auto& edge : edges_of_curves(*result.kept, harmful)) how.features->unmarked.push_back(edge);
    const FeatureChoice choice = chosen_features(surface, how);
    std::optional<RemeshResult> other;
    if (has_creases(choice.features)) other = unless_refused(remesh, choice, in_this_way(result, how));
    if (!other || !is_worth_it(*other, result)) {
      harmful.resize(harmful.size() / 2);
      continue;
    }
    result = std::move(*other);
    number += harmful.size();
    result.given_up = told(choice, number, num_curves);
    result.features_missed = true;
    if (!may_have_harmful_creases(result)) break;
    fewer.features->unmarked = how.features->unmarked;
    harmful = find_harmful();
  }
  return result;
}

}  // namespace fpo
