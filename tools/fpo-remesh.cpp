// fpo-remesh: remesh a surface with blue-noise samples by farthest point optimization.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "fpo/remesh/at_least.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/surface/barycentric.h"
#include "geom/mesh/scaling.h"
#include "io/atomic_file.h"
#include "io/coloured_ply.h"
#include "io/extension.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "io/mesh_picture.h"
#include "io/points.h"
#include "io/polygons.h"
#include "io/surface_map.h"
#include "io/values.h"
#include "tools/cli.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/remesh_arguments.h"
#include "tools/remesh_report.h"
#include "tools/remesh_sizing.h"
#include "tools/surface_input.h"
#include "tools/type_warnings.h"

namespace {

void write_sizing(const std::filesystem::path& path, const geom::TriMesh& input, const fpo::VertexField& h) {
  const std::span<const double> values(h.data(), h.size());
  if (io::lower_extension(path) == ".ply")
    io::write_coloured_ply(path, input, values);
  else
    io::write_values(path, values);
}

void write_map(const std::filesystem::path& path, const geom::TriMesh& input,
               const fpo::RemeshResult& result) {
  const std::vector<geom::Vec3> barycentric = fpo::barycentric_coordinates(input, result.samples);
  std::vector<io::MappedPoint> points;
  for (std::size_t i = 0; i < barycentric.size(); ++i)
    points.push_back({result.samples[i].facet, barycentric[i]});
  io::write_surface_map(path, points);
}

/// The remesh comes last: where it is, all is.
void write_outputs(const tools::RemeshArguments& a, const geom::TriMesh& input,
                   const fpo::RemeshResult& result, const std::string& log) {
  if (!a.points.empty()) {
    std::vector<geom::WeightedPoint3> points;
    for (const fpo::SurfaceSample& sample : result.samples) points.push_back({sample.position, 0});
    io::write_points(a.points, points);
  }
  if (!a.repaired.empty()) io::write_mesh(a.repaired, input);
  const double factor = geom::factor_to_unit_box(input);
  if (!a.map.empty()) write_map(a.map, input, result);
  if (!a.rpd.empty()) {
    std::vector<io::GroupedPolygon> cells;
    for (const fpo::CellPolygon& cell : result.cells) cells.push_back({cell.site.value, cell.corners});
    io::write_polygons(a.rpd, "cell_", cells);
  }
  if (!a.picture.empty()) {
    io::MeshPicture picture;
    picture.back_faces = geom::topology(result.mesh).boundary_edges > 0;
    io::draw_mesh(geom::scaled(result.mesh, factor), picture).save(a.picture);
  }
  if (!a.log.empty()) io::write_file(a.log, log);
  if (!a.sizing_out.empty()) write_sizing(a.sizing_out, input, result.sizing);
  io::write_mesh(a.output, result.mesh);
}

/// Smallest, median and largest wanted length, and how many samples want which.
void print_sizing(const fpo::RemeshResult& result) {
  std::vector<double> h(result.sizing.begin(), result.sizing.end());
  std::ranges::sort(h);
  std::printf("h_min %.6g\nh_median %.6g\nh_max %.6g\nsize_slope %.4f\nsize_cv %.4f\nhidden %zu\n", h.front(),
              h[h.size() / 2], h.back(), result.fit.slope, result.fit.cv, result.hidden);
  std::map<int, std::size_t> decades;
  for (const double value : result.wanted) ++decades[static_cast<int>(std::floor(std::log10(value)))];
  for (const auto& [exponent, samples] : decades) std::printf("samples_with_h_1e%d %zu\n", exponent, samples);
}

void warn(const std::string& line) { std::fprintf(stderr, "warning: %s\n", line.c_str()); }

/// What was decided by default.
void print_features(const fpo::RemeshResult& result, const fpo::RemeshOptions& options) {
  if (!options.features || !options.features->yielding) return;
  if (!result.given_up.empty()) std::printf("%s\n", result.given_up.c_str());
  if (result.crease_curves > 0)
    std::printf("creases kept: %zu curves, %zu edges; --features none to round them off\n",
                result.crease_curves, result.crease_edges);
}

const char* name_of(fpo::StopReason reason) {
  switch (reason) {
    case fpo::StopReason::target_reached:
      return "target_reached";
    case fpo::StopReason::nothing_moved:
      return "nothing_moved";
    case fpo::StopReason::iteration_cap:
      return "iteration_cap";
    case fpo::StopReason::interrupted:
      return "interrupted";
  }
  return "unknown";
}

/// Complaints name the input.
fpo::AtLeastResult remesh_named(const tools::SurfaceInput& input, const tools::RemeshArguments& a) try {
  if (a.at_least) return fpo::remesh_at_least(input.mesh, a.remesh);
  return {fpo::remesh(input.mesh, a.remesh)};
} catch (const geom::InputError& error) {
  throw geom::InputError(io::display_name(a.input) + ": " + error.what() +
                         (input.faults.empty() ? "" : "; the input has " + input.faults));
}

int remesh(tools::CommandLine& cli) {
  tools::interrupt_flag();
  tools::RemeshArguments a = tools::parse_remesh_arguments(cli);
  tools::SurfaceInput read = tools::read_surface(a.input, a.repair);
  const geom::TriMesh& input = read.mesh;
  tools::read_files(a, input);
  tools::settle_sizing(a, read);
  tools::stop_if_interrupted();

  std::string log = "iteration,moved,delta,mean_delta,seconds\n";
  tools::RemeshRun run{cli.command(), a.input, a.remesh, {}, 0, cli.threads()};
  tools::Progress progress("optimizing", cli.quiet());
  const double total_moves = std::max(1.0, double(a.remesh.num_samples) * a.remesh.optimize.max_iterations);
  double delta = 0;
  a.remesh.optimize.interrupted = &tools::interrupt_flag();
  a.remesh.optimize.on_move = [&](std::size_t move) {
    tools::print_notes(read);  // now nothing is refused any more
    progress.update(double(move) / total_moves, delta);
  };
  a.remesh.optimize.on_iteration = [&](const fpo::IterationReport& r) {
    delta = r.delta;
    if (r.iteration == 0) {  // with --at-least there may be several runs: the last one counts
      run.iterations.clear();
      log.resize(log.find('\n') + 1);
    }
    run.iterations.push_back(r);
    char line[160];
    std::snprintf(line, sizeof line, "%d,%zu,%.6f,%.6f,%.6f\n", r.iteration, r.moved, r.delta, r.mean_delta,
                  r.seconds);
    log += line;
  };
  const auto start = std::chrono::steady_clock::now();
  const fpo::AtLeastResult found = remesh_named(read, a);
  const fpo::RemeshResult& result = found.remesh;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  progress.erase();
  tools::print_notes(read);

  write_outputs(a, input, result, log);
  if (!a.report.empty()) tools::write_remesh_report(a.report, input, result, run);
  for (const std::string& line : tools::type_warnings(input, result, a.remesh)) warn(line);
  for (const std::string& line : tools::shape_warnings(result)) warn(line);
  const fpo::OptimizeResult& o = result.optimization;
  const bool interrupted = tools::interrupt_flag();  // maybe after the optimization
  std::printf(
      "samples %zu\niterations %d\nmoves %zu\nstopped %s\ndelta %.6f\nmean_delta %.6f\nseconds %.3f\nwrote "
      "%s\n",
      result.samples.size(), o.last.iteration, o.moves,
      name_of(interrupted ? fpo::StopReason::interrupted : o.reason), result.measures.delta,
      result.measures.mean_delta, o.last.seconds, a.output.c_str());
  if (found.runs > 1)
    std::printf("at_least %zu samples, not enough %zu, runs %zu\n", result.samples.size(), found.not_enough,
                found.runs);
  if (result.radius_factor > 0) std::printf("disk_radius_over_h %.6f\n", result.radius_factor);
  for (const fpo::Reached& r : result.reached) std::printf("%s %.6g\n", r.name, r.value);
  if (a.remesh.sizing != fpo::SizingKind::uniform) print_sizing(result);
  if (result.thin_parts.places > 0)
    std::printf("thin_places %zu\nedges_elsewhere_longer_by %.4f\n", result.thin_parts.places,
                result.thin_parts.scale);
  if (result.brought > 0) std::printf("samples_moved_to_mend %zu\n", result.brought);
  print_features(result, a.remesh);
  if (result.feature_samples > 0)
    std::printf("feature_samples %zu\nfeature_edges %zu\nbroken_feature_edges %zu\nprotected_samples %zu\n",
                result.feature_samples, result.feature_edges, result.broken_feature_edges,
                result.protection.weighted);
  if (a.remesh.improve_fidelity)
    std::printf("far_triangles_tried %zu\nfar_triangles_mended %zu\n", result.fidelity.tried,
                result.fidelity.mended);
  if (a.remesh.maximal)
    std::printf("maximal %d\nmaximal_moves %zu\n", result.maximal.maximal ? 1 : 0, result.maximal.moves);
  if (a.remesh.optimize_angles)
    std::printf("bad_triangles_before %zu\nbad_triangles_after %zu\nmended %zu of %zu, %zu reweighted\n",
                result.angles.bad_before, result.angles.bad_after, result.angles.mended, result.angles.tried,
                result.angles.reweighted);
  if (interrupted) return tools::exit_interrupted;
  return a.strict && !result.type.ok() ? tools::exit_other_topology : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-remesh", argc, argv, remesh); }
