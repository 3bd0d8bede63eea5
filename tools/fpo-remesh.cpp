// fpo-remesh: remesh a surface with blue-noise samples by farthest point optimization.

#include <chrono>
#include <cstdio>
#include <optional>

#include "fpo/remesh/at_least.h"
#include "fpo/remesh/crowd.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/refusal.h"
#include "geom/mesh/scaling.h"
#include "io/atomic_file.h"
#include "io/coloured_ply.h"
#include "io/extension.h"
#include "io/input_file.h"
#include "io/mesh_io.h"
#include "io/mesh_picture.h"
#include "io/polygons.h"
#include "io/values.h"
#include "tools/cli.h"
#include "tools/interrupt.h"
#include "tools/measures.h"
#include "tools/progress.h"
#include "tools/remesh_arguments.h"
#include "tools/remesh_carry.h"
#include "tools/remesh_features.h"
#include "tools/remesh_points.h"
#include "tools/remesh_quality.h"
#include "tools/remesh_report.h"
#include "tools/remesh_sizing.h"
#include "tools/remesh_summary.h"
#include "tools/run_log.h"
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

/// All or none where a format cannot hold a mesh. The remesh comes last: where it is, all is.
void write_outputs(const tools::RemeshArguments& a, const geom::TriMesh& input,
                   const fpo::RemeshResult& result, const std::string& log, bool quiet) {
  if (!a.output.empty()) io::require_mesh(a.output, result.mesh);
  if (!a.repaired.empty()) io::require_mesh(a.repaired, input);
  if (!a.points.empty()) tools::write_points(a, input, result);
  if (!a.repaired.empty()) io::write_mesh(a.repaired, input);
  const double factor = geom::factor_to_unit_box(input);
  if (!a.map.empty()) tools::write_map(a, input, result);
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
  if (a.output.empty()) return;
  std::string dropped;
  tools::write_remesh(a, input, result, dropped);
  if (!dropped.empty() && !quiet) std::fprintf(stderr, "dropped: %s\n", dropped.c_str());
}

void warn(const std::string& line) { std::fprintf(stderr, "warning: %s\n", line.c_str()); }

/// Complaints name the input.
fpo::AtLeastResult remesh_named(const tools::SurfaceInput& input, const tools::RemeshArguments& a) try {
  fpo::refuse_soup(input.mesh, input.parts, a.remesh.num_samples);
  fpo::AtLeastResult result;
  if (a.remesh.sheets != fpo::Sheets::apart) fpo::refuse_crowd(input.mesh, a.remesh.num_samples);
  if (!a.at_least && a.remesh.sizing == fpo::SizingKind::uniform)
    fpo::refuse_thread(input.mesh, a.remesh.num_samples);
  if (a.at_least)
    result = fpo::remesh_at_least(input.mesh, a.remesh);
  else
    result.remesh = fpo::remesh(input.mesh, a.remesh);
  fpo::refuse_remnant(result.remesh.mesh, result.remesh.feature_bound.samples);
  return result;
} catch (const geom::InputError& error) {
  throw geom::InputError(io::display_name(a.input) + ": " + error.what() +
                         (input.faults.empty() ? "" : "; the input has " + input.faults));
}

int remesh(tools::CommandLine& cli) {
  tools::RemeshArguments a = tools::parse_remesh_arguments(cli);
  tools::EndsAtOnce nothing_to_save(tools::nothing_is_written(cli.program()));
  tools::SurfaceInput read = tools::read_surface(a.input, a.repair);
  const geom::TriMesh& input = read.mesh;
  tools::read_files(a, input);
  tools::mark_features(a, read);
  tools::settle_sizing(a, read);

  const bool uniform = a.remesh.sizing == fpo::SizingKind::uniform;
  std::string log =
      uniform ? tools::log_head : "iteration,moved,delta_of_wanted,mean_delta_of_wanted,seconds\n";
  tools::RemeshRun run{cli.command(), a.input, a.remesh, {}, 0, cli.threads(), cli.quiet()};
  tools::Progress progress("optimizing", cli.quiet());
  const double total_moves = std::max(1.0, double(a.remesh.num_samples) * a.remesh.optimize.max_iterations);
  double delta = 0;
  a.remesh.optimize.interrupted = &tools::interrupt_flag();
  a.remesh.optimize.on_move = [&](std::size_t move) {
    nothing_to_save.end();
    if (progress.is_visible()) tools::print_notes(read);  // who waits reads them now
    progress.update(double(move) / total_moves, delta);
  };
  a.remesh.optimize.on_iteration = [&](const fpo::IterationReport& r) {
    nothing_to_save.end();
    delta = r.delta;
    if (r.iteration == 0) {  // with --at-least there may be several runs: the last one counts
      run.iterations.clear();
      log.resize(log.find('\n') + 1);
    }
    run.iterations.push_back(r);
    log += tools::log_line(r);
  };
  if (!a.output.empty())  // better said before than after
    io::require_edges(a.output, input, fpo::hexagonal_spacing(input.area(), a.remesh.num_samples));
  const auto start = std::chrono::steady_clock::now();
  const fpo::AtLeastResult found = remesh_named(read, a);
  const fpo::RemeshResult& result = found.remesh;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  nothing_to_save.end();
  progress.erase();

  write_outputs(a, input, result, log, cli.quiet());
  if (!a.report.empty()) tools::write_remesh_report(a.report, input, result, run);
  tools::print_notes(read);  // now nothing is refused any more
  for (const std::string& line : tools::type_warnings(input, result, a.remesh)) warn(line);
  for (const std::string& line : tools::shape_warnings(input, result, a.remesh)) warn(line);
  const bool interrupted = tools::interrupt_flag();  // maybe after the optimization
  std::optional<tools::EndsAtOnce> all_saved;
  if (!interrupted) all_saved.emplace(tools::all_is_written(cli.program()));
  std::optional<fpo::SurfaceDistance> distance;
  if (a.hausdorff && !interrupted && result.mesh.num_facets() > 0)
    distance = tools::measure(result.mesh, input, cli.threads()).distance;
  tools::summary_of(a, input, found, run, distance).print(a.json);
  if (interrupted) return tools::exit_interrupted;
  return a.strict && !result.type.ok() ? tools::exit_other_topology : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-remesh", argc, argv, remesh); }
