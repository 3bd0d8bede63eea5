#include "fpo/pipeline.h"

#include <cmath>
#include <string>

#include "fpo/curvature.h"
#include "fpo/local_feature_size.h"
#include "geom/check.h"

namespace fpo {
namespace {

/// The power of two that brings the largest coordinate into [1/2, 1).
double scale_to_unit(const geom::TriMesh& mesh) {
  const double largest =
      std::max(mesh.box().min().lpNorm<Eigen::Infinity>(), mesh.box().max().lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, -exponent);
}

geom::TriMesh scaled(const geom::TriMesh& mesh, double factor) {
  geom::Table<geom::VertexId, geom::Vec3> vertices = mesh.vertices();
  for (geom::Vec3& v : vertices) v *= factor;
  return geom::TriMesh(std::move(vertices), mesh.facets());
}

VertexField local_feature_sizes(const geom::TriMesh& surface, double spacing) {
  LocalFeatureSizeOptions options;
  options.spacing = 0.3 * spacing;
  VertexField lfs = local_feature_size(surface, options);
  for (double& value : lfs) value = std::max(value, 1e-6 * spacing);  // 0 is not excluded
  return lfs;
}

VertexField wanted_sizes(const geom::TriMesh& surface, const RemeshOptions& options, double spacing) {
  switch (options.sizing) {
    case SizingKind::local_feature_size:
      return local_feature_sizes(surface, spacing);
    case SizingKind::curvature:
      return curvature_size(surface, {.min = 1e-6 * spacing});
    default:
      return options.rho;
  }
}

/// The sizing, and the samples that stay.
SharedSizing sizing_and_features(const geom::TriMesh& surface, const RemeshOptions& options) {
  const double spacing = hexagonal_spacing(surface.area(), options.num_samples);
  Features features;
  if (options.features) {
    FeatureOptions feature_options = *options.features;
    feature_options.turn_scale = spacing / 2;
    features = find_features(surface, feature_options);
  }
  const VertexField rho =
      options.sizing == SizingKind::uniform ? VertexField() : wanted_sizes(surface, options, spacing);
  const auto sizing_for = [&](std::size_t n) {
    if (options.sizing == SizingKind::uniform) return Sizing::uniform(hexagonal_spacing(surface.area(), n));
    return fit_sizing(surface, rho, n, options.limits);
  };
  return share_sizing(surface, features, points_on_surface(surface, options.fixed), options.num_samples,
                      sizing_for, options.seed);
}

/// Those that stay, then random ones.
std::vector<SurfaceSample> initial_samples(const geom::TriMesh& surface, const SharedSizing& shared,
                                           const RemeshOptions& options) {
  std::vector<SurfaceSample> samples = shared.features.samples;
  if (samples.size() == options.num_samples) return samples;
  const std::vector<SurfaceSample> inner =
      random_samples(surface, shared.sizing, options.num_samples - samples.size(), options.seed);
  samples.insert(samples.end(), inner.begin(), inner.end());
  return samples;
}

RemeshResult remesh_in_unit_box(const geom::TriMesh& surface, const RemeshOptions& options) {
  RemeshResult result;
  const SharedSizing shared = sizing_and_features(surface, options);
  const Sizing& sizing = shared.sizing;
  SurfaceOptions surface_options = options.surface;
  surface_options.seed = options.seed;
  surface_options.num_fixed = shared.features.samples.size();
  SurfaceDomain domain(surface, sizing, initial_samples(surface, shared, options), surface_options);
  OptimizeOptions optimization = options.optimize;
  optimization.seed = options.seed;
  optimization.order = VisitOrder::in_turn;  // the initial samples are in random order already
  if (options.shortest_edge_removal) {
    ShortestEdgeOptions removal;
    removal.interrupted = optimization.interrupted;
    result.shortest_edges = remove_shortest_edges(domain, removal);
  }
  result.optimization = optimize(domain, optimization);
  if (options.optimize_angles) {
    AngleOptions angles;
    angles.interrupted = optimization.interrupted;
    result.angles = optimize_angles(domain, angles);
  }
  result.hidden = domain.num_hidden();
  result.localization = domain.localize();
  result.mesh = extract(domain.diagram(), domain.num_samples());
  result.feature_samples = shared.features.samples.size();
  result.feature_edges = num_edges(shared.features);
  result.broken_feature_edges = num_broken_edges(result.mesh, shared.features);
  for (std::size_t i = 0; i < domain.num_samples(); ++i) result.samples.push_back(domain.sample(SiteId(i)));
  for (std::size_t v = 0; v < surface.num_vertices(); ++v)
    result.sizing.push_back(sizing.at(geom::VertexId(v)));
  for (const SurfaceSample& sample : result.samples) result.wanted.push_back(sizing.at(sample));
  result.fit = sizing_fit(result.mesh, result.wanted);
  if (options.keep_cells) result.cells = cell_polygons(domain.diagram());
  return result;
}

}  // namespace

RemeshResult remesh(const geom::TriMesh& input, const RemeshOptions& options) try {
  geom::require(input.area() > 0 && options.num_samples > 0,
                "the surface has no area or the samples no number");
  const double factor = scale_to_unit(input);
  RemeshOptions scaled_options = options;
  for (geom::Vec3& point : scaled_options.fixed) point *= factor;
  RemeshResult result = remesh_in_unit_box(scaled(input, factor), scaled_options);
  result.mesh = scaled(result.mesh, 1 / factor);
  for (SurfaceSample& sample : result.samples) sample.position /= factor;
  for (double& h : result.sizing) h /= factor;
  for (double& h : result.wanted) h /= factor;
  for (CellPolygon& cell : result.cells)
    for (geom::Vec3& corner : cell.corners) corner /= factor;
  return result;
} catch (const geom::Bug& bug) {
  throw geom::Bug("seed " + std::to_string(options.seed) + ", " + bug.what());
}

}  // namespace fpo
