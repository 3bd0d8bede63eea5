#include "fpo/remesh/feature_bound.h"

#include "fpo/features/feature_choice.h"
#include "fpo/features/feature_samples.h"
#include "fpo/remesh/remesh_task.h"

namespace fpo {
namespace {

constexpr int raises = 20;
constexpr std::size_t steps = 8;

/// Corners that are seen at the scale of few samples only take some more of them.
bool are_kept(const geom::TriMesh& surface, const RemeshOptions& options, std::size_t n) {
  RemeshOptions with = options;
  with.num_samples = n;
  const FeatureChoice choice = chosen_features(surface, with);
  return choice.given_up.empty() && choice.collapsed == 0;
}

}  // namespace

FeatureBound feature_bound(const geom::TriMesh& surface, const RemeshOptions& options) {
  if (!options.features || options.method != Method::fpo) return {};
  const double spacing = even_spacing(surface, options);
  const Features features = all_features(surface, *options.features, spacing);
  if (features.curves.empty()) return {};
  const std::vector<SurfaceSample> fixed = points_on_surface(surface, options.fixed);
  const bool has_marks = !options.features->marked.empty();  // on facets as they are
  const double gradation = has_marks ? 0 : curve_gradation(options);
  FeatureBound bound =
      samples_for_features({surface, features, fixed, plain_sizing(surface, options)(options.num_samples),
                            options.num_samples, options.features->yielding, gradation});
  for (int i = 0; i < raises && bound.samples > 0 && !are_kept(surface, options, bound.samples); ++i)
    bound.samples += bound.samples / steps + 1;
  return bound;
}

}  // namespace fpo
