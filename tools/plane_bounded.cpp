#include "tools/plane_bounded.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

#include "fpo/measure/covering.h"
#include "fpo/measure/quality.h"
#include "fpo/plane/rectangle.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/surface/sizing.h"
#include "io/atomic_file.h"
#include "io/mesh_io.h"
#include "io/points.h"
#include "tools/interrupt.h"
#include "tools/plane_sizing_source.h"
#include "tools/run_log.h"
#include "tools/summary.h"

namespace tools {
namespace {

/// Along the longer side, if adaptive: h is linear on each half of a cell. About four samples a cell, for
/// many facets cost time.
int cells_for(std::size_t num_samples) {
  return static_cast<int>(std::clamp(std::sqrt(static_cast<double>(num_samples)) / 2, 8.0, 128.0));
}

fpo::RemeshOptions remesh_options(const PlaneArguments& a, std::uint64_t seed, const fpo::PlaneSizing& sizing,
                                  const geom::TriMesh& rectangle) {
  fpo::RemeshOptions options;
  options.num_samples = a.num_samples;
  options.seed = seed;
  if (!sizing.is_uniform()) {
    options.sizing = fpo::SizingKind::given;
    options.rho = fpo::rho_at_vertices(rectangle, sizing);
    options.limits = {.gradation = 10, .smallest = 1e-3, .largest = 1e3};  // the sizing has its own
  }
  options.optimize = a.optimize;
  options.optimize.scope = a.scope.value_or(sizing.is_uniform() ? fpo::Scope::global : fpo::Scope::two_ring);
  options.surface.weight_factor = a.weight_factor.value_or(fpo::best_weight_factor(options.optimize.scope));
  options.surface.corners = a.corners;
  options.shortest_edge_removal = a.ser;
  options.optimize_angles = a.optimize_angles;
  options.keep_cells = a.picture.cells || a.picture.colour;
  return options;
}

/// The samples come last: where they are, all is.
void write_outputs(const PlaneArguments& a, const fpo::RemeshResult& result, const std::string& log) {
  if (!a.log.empty()) io::write_file(a.log, log);
  if (a.writes_mesh()) {
    io::write_mesh(a.output, result.mesh);
  } else if (a.writes_svg()) {
    draw_rectangle(result, a.period, a.picture).save(a.output);
  } else {
    std::vector<geom::WeightedPoint2> points;
    for (const fpo::SurfaceSample& sample : result.samples) points.push_back({sample.position.head<2>(), 0});
    io::write_points(a.output, points);
  }
}

/// Scaled back, the last bit may be beyond the border.
void keep_within(const geom::Box3& box, fpo::RemeshResult& result) {
  const auto within = [&](const geom::Vec3& p) -> geom::Vec3 {
    return p.cwiseMax(box.min()).cwiseMin(box.max());
  };
  for (fpo::SurfaceSample& x : result.samples) x.position = within(x.position);
  geom::Table<geom::VertexId, geom::Vec3> vertices = result.mesh.vertices();
  for (geom::Vec3& p : vertices) p = within(p);
  result.mesh = result.mesh.with_vertices(std::move(vertices));
}

/// Of what is written: the distances to the nearest sample, the least and the mean, in units of d_max; or, if
/// adaptive, of the lengths wanted.
std::pair<double, double> spacing_of(const fpo::RemeshResult& result, double area, bool uniform) {
  if (!uniform) return {result.measures.delta, result.measures.mean_delta};
  std::vector<geom::Vec3> places;
  for (const fpo::SurfaceSample& x : result.samples) places.push_back(x.position);
  const std::vector<double> distances = fpo::nearest_distances(places);
  const double most = fpo::hexagonal_spacing(area, places.size());
  const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
  return {std::ranges::min(distances) / most, sum / static_cast<double>(places.size()) / most};
}

}  // namespace

int run_bounded_plane(PlaneArguments& a, std::uint64_t seed, bool quiet) {
  const geom::FlatTorus torus(a.period);
  const auto sizing = make_plane_sizing(a, torus);
  const geom::TriMesh rectangle =
      fpo::rectangle_mesh(torus.period(), sizing->is_uniform() ? 1 : cells_for(a.num_samples));
  stop_if_interrupted();
  RunLog log(quiet);
  log.attach(a.optimize, a.num_samples);
  const fpo::RemeshOptions options = remesh_options(a, seed, *sizing, rectangle);
  fpo::RemeshResult result = fpo::remesh(rectangle, options);
  keep_within(rectangle.box(), result);
  const bool interrupted = interrupt_flag();  // maybe after the optimization
  write_outputs(a, result, log.csv());
  const fpo::Quality q = fpo::quality(result.mesh, rectangle.area());
  const fpo::OptimizeResult& o = result.optimization;
  const bool uniform = sizing->is_uniform();
  const auto [delta, mean_delta] = spacing_of(result, rectangle.area(), uniform);
  if (const fpo::TypeCheck& type = result.type; !type.ok())
    std::fprintf(
        stderr,
        "warning: the triangulation is no disk: %zu samples have no triangle, %zu edges and %zu vertices are "
        "not a manifold's; more samples would help, or lengths that differ less\n",
        type.bare_samples, type.nonmanifold_edges, type.nonmanifold_vertices);
  Summary summary;
  summary.count("samples", a.num_samples);
  summary.count("iterations", static_cast<std::size_t>(o.last.iteration));
  summary.count("moves", o.moves);
  summary.number(uniform ? "delta" : "delta_of_wanted", delta, 6);
  summary.number(uniform ? "mean_delta" : "mean_delta_of_wanted", mean_delta, 6);
  summary.number("size_slope", result.fit.slope, 4);
  summary.number("size_cv", result.fit.cv, 4);
  summary.number("theta_min", q.theta_min, 3);
  summary.number("theta_min_avg", q.theta_min_avg, 3);
  summary.number("theta_max", q.theta_max, 3);
  summary.count("hidden", result.hidden);
  summary.number("seconds", o.last.seconds, 3);
  summary.text("wrote", a.output.string());
  summary.print(a.json);
  return interrupted ? exit_interrupted : exit_done;
}

}  // namespace tools
