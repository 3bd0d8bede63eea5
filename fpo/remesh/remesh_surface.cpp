#include "fpo/remesh/remesh_surface.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fpo/remesh/attempts.h"
#include "fpo/remesh/feature_bound.h"
#include "fpo/remesh/last_resort.h"
#include "fpo/remesh/noise.h"
#include "fpo/remesh/other_samples.h"
#include "fpo/remesh/remesh_task.h"
#include "fpo/remesh/sheet_ways.h"
#include "fpo/remesh/trimmed_remesh.h"
#include "fpo/remesh/unless_interrupted.h"
#include "fpo/remesh/useful_creases.h"
#include "geom/check.h"

namespace fpo {
namespace {

/// Or without any if with them it is refused.
RemeshResult remesh_unless_refused(const geom::TriMesh& surface, const RemeshOptions& options) try {
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

/// The same, with other samples if few flaws are left.
RemeshResult remesh_with_creases_or_not(const geom::TriMesh& surface, const RemeshOptions& options) {
  return with_other_samples(surface, options, remesh_unless_refused(surface, options), first_way_if_time);
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

}  // namespace

RemeshResult remesh_surface(const geom::TriMesh& surface, const RemeshOptions& options) {
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

}  // namespace fpo
