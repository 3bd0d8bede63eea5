#include "fpo/remesh/remesh_task.h"

#include <algorithm>

#include "fpo/remesh/blends.h"
#include "fpo/remesh/small_loops.h"
#include "fpo/remesh/small_parts.h"

namespace fpo {

// Steeper than elsewhere, for what is refined there is taken from all others.
double curve_gradation(const RemeshOptions& options) { return std::max(0.18, options.limits.gradation); }

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

SizingFor plain_sizing(const geom::TriMesh& surface, const RemeshOptions& options) {
  const auto rho_of = facts_of(options.sizing).rho;
  if (!rho_of)
    return [&surface](std::size_t n) { return Sizing::uniform(hexagonal_spacing(surface.area(), n)); };
  return [&surface, limits = options.limits,
          rho = rho_of({surface, options.num_samples, even_spacing(surface, options), options.rho,
                        options.threads})](std::size_t n) { return fit_sizing(surface, rho, n, limits); };
}

SizingFor part_sizing(const geom::TriMesh& surface, const Features& features, const RemeshOptions& options) {
  SizingFor plain = plain_sizing(surface, options);
  if (options.sizing != SizingKind::uniform || options.method != Method::fpo || !options.mend) return plain;
  const double gradation = curve_gradation(options);
  if (!sizing_beside_blends(surface, features, options.num_samples, gradation)) return plain;
  return [&surface, &features, plain, gradation](std::size_t n) {
    const std::optional<Sizing> beside = sizing_beside_blends(surface, features, n, gradation);
    return beside ? *beside : plain(n);
  };
}

namespace {

double longest_on_curves(const Features& features, const Sizing& sizing) {
  double longest = 0;
  for (const FeatureCurve& curve : features.curves)
    for (const geom::VertexId v : curve.vertices) longest = std::max(longest, sizing.at(v));
  return longest;
}

}  // namespace

std::optional<NarrowSurface> helpful_narrow_surface(const geom::TriMesh& surface, const Features& features,
                                                    const SizingFor& plain, const RemeshOptions& options) {
  const bool has_marks = options.features && !options.features->marked.empty();  // on facets as they are
  if (options.method != Method::fpo || has_marks || features.curves.empty()) return {};
  const double spacing = even_spacing(surface, options);
  const std::size_t n = options.num_samples;
  const Sizing base = plain(n);
  std::optional<NarrowSurface> narrow =
      narrow_surface(surface, features, spacing, curve_gradation(options), longest_on_curves(features, base));
  if (!narrow) return {};
  const CurveFit fit = fit_sizing_to_curves(surface, base, *narrow, n);
  if (!fit.helped) return {};
  split_less(*narrow, surface, spacing, fit.least);
  return narrow;
}

namespace {

constexpr double most_on_small_parts =
    0.25;  // of the samples, on features, by lengths that are lowered there

SharedSizing share(const RemeshTask& task, const RemeshOptions& options, const SizingFor& sizing_for) {
  return share_sizing(
      task.surface(), task.features, points_on_surface(task.surface(), options.fixed), sizing_for,
      {options.num_samples, options.seed, {}, options.facing_samples, options.staggered_samples});
}

/// With room for small components: before their features are sampled or, if these took too many samples then,
/// afterwards.
SharedSizing with_small_parts(const RemeshTask& task, const RemeshOptions& options,
                              const SizingFor& sizing_for, SharedSizing shared) {
  const SmallParts parts(task.surface());
  const std::size_t n = options.num_samples;
  const double most_scale = ThinPartOptions().most_scale;
  if (!parts.room(shared.sizing, n, most_scale)) return shared;
  SharedSizing lowered = share(task, options, [&](std::size_t count) {
    const Sizing sizing = sizing_for(count);
    return parts.room(sizing, count, most_scale).value_or(sizing);
  });
  lowered.has_small_parts = true;
  const auto more = static_cast<double>(lowered.features.samples.size()) -
                    static_cast<double>(shared.features.samples.size());
  if (more <= most_on_small_parts * static_cast<double>(n)) return lowered;
  std::optional<Sizing> room = parts.room(shared.sizing, n, most_scale, shared.features.samples);
  shared.has_small_parts = room.has_value();
  if (room) shared.sizing = *std::move(room);
  return shared;
}

}  // namespace

SharedSizing sizing_and_features(const RemeshTask& task, const RemeshOptions& options) {
  const SizingFor sizing_for = [&](std::size_t n) {
    return task.narrow ? fit_sizing_to_curves(task.input, task.plain(n), *task.narrow, n).sizing
                       : task.plain(n);
  };
  SharedSizing shared = share(task, options, sizing_for);
  // Of lengths that were given none is changed.
  if (!options.mend || options.method != Method::fpo || options.sizing == SizingKind::given) return shared;
  shared = with_small_parts(task, options, sizing_for, std::move(shared));
  const ThinPartOptions thin;
  SmallLoopOptions loops{thin.gradation, thin.most_scale};
  if (options.sizing != SizingKind::uniform) loops.most_edges = 3;
  shared.sizing = make_room_for_small_loops(task.surface(), shared, options.num_samples, loops).sizing;
  return shared;
}

}  // namespace fpo
