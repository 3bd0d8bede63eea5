#include "fpo/remesh/last_resort.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "fpo/features/corner_angles.h"
#include "fpo/interruption.h"
#include "fpo/remesh/attempts.h"
#include "fpo/remesh/collapsed_mesh.h"
#include "fpo/remesh/flips_towards.h"
#include "fpo/remesh/recovered_edges.h"
#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr int farthest_iterations = 10;  // along the surface

/// To mend angles, for nobody has looked at them yet.
std::size_t attempts_for(std::size_t n) { return std::max(std::min<std::size_t>(4 * n, 1000), n / 2); }

/// The part of a facet that a place is in, of a surface with smaller facets.
FacetId part_at(const SplitSurface& apart, const SurfaceSample& place) {
  FacetId best;
  double least = std::numeric_limits<double>::infinity();
  for (FacetId t(0); t.index() < apart.parents.size(); t = FacetId(t.value + 1)) {
    if (apart.parents[t] != place.facet) continue;
    const TriMesh& mesh = apart.mesh;
    const double d =
        geom::closest_point(place.position, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)})
            .distance2;
    if (d < least) least = d, best = t;
  }
  return best;
}

/// How samples are joined.
struct Joining {
  std::span<const SurfaceSample> samples;
  const Sizing& sizing;
  int iterations;  ///< of farthest point optimization along the surface
};

/// None if there are vertices left.
std::optional<RemeshResult> joined(const SampledTask& sampled, const RemeshOptions& options,
                                   const Joining& how, const RemeshResult& result) {
  const TriMesh& surface = sampled.apart ? sampled.apart->mesh : sampled.task.surface();
  std::vector<SurfaceSample> samples(how.samples.begin(), how.samples.end());
  std::vector<double> wanted;
  for (const SurfaceSample& x : samples) wanted.push_back(how.sizing.at(x));
  if (sampled.apart)
    for (SurfaceSample& x : samples) x.facet = sampled.apart->parents[x.facet];
  auto collapsed =
      collapsed_mesh({sampled.task.surface(), sampled.task.features, sampled.shared.features, samples},
                     wanted, options.optimize.interrupted, how.iterations);
  if (!collapsed) return {};
  RemeshResult other = result;
  other.samples.assign(how.samples.begin(), how.samples.end());
  other.mesh = std::move(collapsed->mesh);
  if (how.iterations == 0)
    other.mesh = flipped_towards(other.mesh, result.mesh, chain_edges(sampled.shared.features));
  for (const auto& [x, place] : collapsed->exchanged) {
    other.samples[x.index()] = place;
    if (sampled.apart) other.samples[x.index()].facet = part_at(*sampled.apart, place);
  }
  AngleOptions angles = options.angles;
  angles.interrupted = options.optimize.interrupted;
  other.finish = {};
  if (options.optimize_angles)
    other.finish.last_angles = mend_last_angles({surface,
                                                 how.sizing,
                                                 sampled.shared.features,
                                                 sampled.slides,
                                                 angles,
                                                 {.most_attempts = attempts_for(samples.size())}},
                                                other.mesh, other.samples);
  other.type = check_type(sampled.type, other.mesh, other.samples);
  other.advice = {};
  other.by_collapses = true;
  if (how.iterations > 0) other.thin_parts.places = 0, other.thin_parts.scale = 1;  // lengths are as wanted
  if (options.keep_cells) other.cells = cells_of(surface, how.sizing, other.samples, options.surface);
  tell_of_features(sampled.task, sampled.shared, other);
  tell_of_lengths(sampled.task, how.sizing, angles, other);
  return other;
}

}  // namespace

std::shared_ptr<const RemeshResult> last_resort(const SampledTask& sampled, const RemeshOptions& options,
                                                const RemeshResult& result) {
  const auto is_over = [&] { return fpo::interrupted(options.optimize.interrupted); };
  if (!options.mend || options.method != Method::fpo || is_over() ||
      (result.type.ok() && result.broken_feature_edges == 0))
    return {};
  const bool unmended = !result.type.ok() && !sampled.unmended.empty();
  std::optional<RemeshResult> best =
      joined(sampled, options, {unmended ? sampled.unmended : result.samples, sampled.sizing, 0}, result);
  if (!result.type.ok() && !is_over() && !(best && has_wanted_angles(*best))) {
    std::optional<RemeshResult> spread =
        joined(sampled, options, {result.samples, sampled.shared.sizing, farthest_iterations}, result);
    if (spread && (!best || is_better(*spread, *best))) best = std::move(spread);
  }
  return best ? std::make_shared<const RemeshResult>(std::move(*best)) : nullptr;
}

RemeshResult or_last_resort(RemeshResult result) {
  RemeshResult other = as_it_will_be(result);
  other.last_resort.reset();  // settled: what follows maps only one
  other.given_up = std::move(result.given_up);
  other.features_missed = result.features_missed;
  other.collapsed_curves = result.collapsed_curves;
  other.least_length = result.least_length;
  return other;
}

void tell_of_features(const RemeshTask& task, const SharedSizing& shared, RemeshResult& result) {
  result.feature_samples = shared.features.samples.size();
  result.staggered_curves = shared.features.staggered_curves;
  result.feature_edges = num_edges(shared.features);
  const CornerAngles corners = corner_angles(task.surface(), task.features);
  result.corner_angle = corners.smallest;
  result.sharp_corners = corners.below_30;
  result.crease_curves = result.crease_edges = 0;
  for (std::size_t c = 0; c < task.features.curves.size(); ++c)
    if (task.features.curves[c].sheets == 2)
      ++result.crease_curves, result.crease_edges += shared.features.chains[c].size() - 1;
  const auto broken = broken_edges(result.mesh, shared.features);
  result.broken_feature_edges = broken.size();
  result.edge_advice = edge_advice(result.mesh, broken);
}

void tell_of_lengths(const RemeshTask& task, const Sizing& sizing, const AngleOptions& angles,
                     RemeshResult& result) {
  result.sizing.clear();
  result.wanted.clear();
  for (std::size_t v = 0; v < task.input.num_vertices(); ++v)
    result.sizing.push_back(sizing.at(geom::VertexId(v)));
  for (const SurfaceSample& sample : result.samples) result.wanted.push_back(sizing.at(sample));
  result.fit = sizing_fit(result.mesh, result.wanted);
  result.measures = final_measures(result.mesh, result.wanted, result.feature_samples, angles);
  result.angles.bad_after = result.measures.bad_triangles;
}

}  // namespace fpo
