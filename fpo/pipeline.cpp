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

Sizing sizing_of(const geom::TriMesh& surface, const RemeshOptions& options) {
  const double spacing = hexagonal_spacing(surface.area(), options.num_samples);
  if (options.sizing == SizingKind::uniform) return Sizing::uniform(spacing);
  return fit_sizing(surface, wanted_sizes(surface, options, spacing), options.num_samples, options.limits);
}

RemeshResult remesh_in_unit_box(const geom::TriMesh& surface, const RemeshOptions& options) {
  RemeshResult result;
  const Sizing sizing = sizing_of(surface, options);
  SurfaceOptions surface_options = options.surface;
  surface_options.seed = options.seed;
  SurfaceDomain domain(surface, sizing, random_samples(surface, sizing, options.num_samples, options.seed),
                       surface_options);
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
  RemeshResult result = remesh_in_unit_box(scaled(input, factor), options);
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
