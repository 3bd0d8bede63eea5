// fpo-remesh: remesh a surface with blue-noise samples by farthest point optimization.

#include <cstdio>

#include "fpo/pipeline.h"
#include "io/atomic_file.h"
#include "io/mesh_io.h"
#include "io/mesh_picture.h"
#include "io/points.h"
#include "io/polygons.h"
#include "tools/cli.h"
#include "tools/interrupt.h"
#include "tools/progress.h"

namespace {

namespace fs = std::filesystem;

struct Arguments {
  fs::path input, output, points, rpd, log, picture;
  fpo::RemeshOptions remesh;
};

/// An option whose issue has not come yet: the values in `today` are accepted and change nothing.
void declare_later(tools::CommandLine& cli, tools::Option option, std::string today) {
  option.help += " (not yet: only '" + today + "')";
  option.standard = today;
  cli.custom(option, [name = option.name, today](const std::string& text) {
    geom::require(text == today, "--" + name + " " + text + " does not work yet; only '" + today + "' does");
  });
}

void declare_later(tools::CommandLine& cli, const std::string& name, const std::string& help) {
  cli.custom({.name = name, .value = "FILE", .help = help + " (not yet)"},
             [name](const std::string&) { throw geom::InputError("--" + name + " does not work yet"); });
}

void parse(tools::CommandLine& cli, Arguments& a) {
  cli.describe("INPUT", "Remeshes a surface (obj, off, ply, stl) with COUNT samples of blue noise.");
  cli.group("Result");
  cli.integer({.name = "count",
               .letter = 'n',
               .value = "COUNT",
               .help = "number of samples: exactly the vertices of OUT",
               .required = true},
              a.remesh.num_samples, 1, 100'000'000);
  cli.path({.name = "output",
            .letter = 'o',
            .value = "OUT",
            .help = "the remesh: .obj .off .ply .stl",
            .required = true},
           a.output);
  cli.path({.name = "points", .value = "OUT", .help = "the samples: .xyz .ply"}, a.points);
  cli.path({.name = "rpd", .value = "OUT.obj", .help = "the restricted power diagram, a group a cell"},
           a.rpd);
  cli.path({.name = "picture", .value = "OUT.svg", .help = "a drawing of the remesh"}, a.picture);
  cli.path({.name = "log", .value = "OUT.csv", .help = "iteration, moved, delta, mean_delta, seconds"},
           a.log);
  declare_later(cli, "report", "a report in one file");

  cli.group("Optimization");
  cli.integer({.name = "iterations", .value = "MAX", .help = "at most so many"},
              a.remesh.optimize.max_iterations, 0, 1'000'000);
  cli.number({.name = "target-delta", .value = "D", .help = "stop when delta exceeds it"},
             a.remesh.optimize.target_delta, 0, 2);
  cli.choice({.name = "corners",
              .value = "c|all",
              .help = "where the farthest point may lie: on type C corners as in the "
                      "paper, or on A and B too"},
             a.remesh.corners, {{"c", geom::CornerTypes::c_only}, {"all", geom::CornerTypes::all}});
  cli.choice(
      {.name = "engine", .value = "search|triangulation", .help = "where neighbours come from; same result"},
      a.remesh.engine, {{"search", fpo::Engine::search}, {"triangulation", fpo::Engine::triangulation}});
  declare_later(cli, {.name = "sizing", .value = "KIND", .help = "wanted edge lengths"}, "uniform");
  declare_later(cli, {.name = "features", .value = "KIND", .help = "creases and borders to keep"}, "none");
  declare_later(cli, "gradation", "limit of the sizing's slope");
  bool ser = false, local = false, global = true, angles = false;
  cli.toggle({.name = "ser", .help = "shortest edge removal first (not yet)"}, ser);
  cli.toggle({.name = "optimize-angles", .help = "angle optimization afterwards (not yet)"}, angles);
  cli.flag({.name = "local", .help = "look for farthest points nearby only (not yet)"}, local);
  cli.flag({.name = "global", .help = "look for them everywhere"}, global);
  a.input = cli.parse(1, 1).front();
  geom::require(!ser && !local && !angles, "--ser, --local and --optimize-angles do not work yet");
  a.remesh.seed = cli.seed();
  a.remesh.keep_cells = !a.rpd.empty();
}

/// Refuses bad output names before the work starts.
void check_outputs(const Arguments& a) {
  io::mesh_format(a.output);
  if (!a.points.empty())
    geom::require(io::point_format(a.points) != io::PointFormat::txt,
                  a.points.string() + ": use .xyz or .ply");
  for (const fs::path& path : {a.output, a.points, a.rpd, a.log, a.picture})
    if (!path.empty()) io::require_writable(path);
}

void write_outputs(const Arguments& a, const fpo::RemeshResult& result, const std::string& log) {
  io::write_mesh(a.output, result.mesh);
  if (!a.points.empty()) {
    std::vector<geom::WeightedPoint3> points;
    for (const fpo::SurfaceSample& sample : result.samples) points.push_back({sample.position, 0});
    io::write_points(a.points, points);
  }
  if (!a.rpd.empty()) {
    std::vector<io::GroupedPolygon> cells;
    for (const fpo::CellPolygon& cell : result.cells) cells.push_back({cell.site.value, cell.corners});
    io::write_polygons(a.rpd, "cell_", cells);
  }
  if (!a.picture.empty()) io::draw_mesh(result.mesh, {.back_faces = true}).save(a.picture);
  if (!a.log.empty()) io::write_file(a.log, log);
}

void warn_if_not_homeomorphic(const geom::TriMesh& input, const geom::TriMesh& output) {
  const geom::Topology in = geom::topology(input), out = geom::topology(output);
  if (!out.manifold())
    std::fprintf(stderr,
                 "warning: the remesh is not a manifold: %zu non-manifold edges, %zu non-manifold vertices\n",
                 out.nonmanifold_edges, out.nonmanifold_vertices);
  if (out.unreferenced_vertices > 0)
    std::fprintf(stderr, "warning: %zu samples have no triangle\n", out.unreferenced_vertices);
  if (in.manifold() &&
      (in.euler != out.euler || in.components != out.components || in.boundary_loops != out.boundary_loops))
    std::fprintf(
        stderr,
        "warning: Euler number %ld, %zu components, %zu boundary loops; the input has %ld, %zu, %zu\n",
        out.euler, out.components, out.boundary_loops, in.euler, in.components, in.boundary_loops);
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

int remesh(tools::CommandLine& cli) {
  Arguments a;
  parse(cli, a);
  check_outputs(a);
  const geom::TriMesh input = io::read_mesh(a.input);

  std::string log = "iteration,moved,delta,mean_delta,seconds\n";
  tools::Progress progress("optimizing", cli.quiet());
  const double total_moves = std::max(1.0, double(a.remesh.num_samples) * a.remesh.optimize.max_iterations);
  double delta = 0;
  a.remesh.optimize.interrupted = &tools::interrupt_flag();
  a.remesh.optimize.on_move = [&](std::size_t move) { progress.update(double(move) / total_moves, delta); };
  a.remesh.optimize.on_iteration = [&](const fpo::IterationReport& r) {
    delta = r.delta;
    char line[160];
    std::snprintf(line, sizeof line, "%d,%zu,%.6f,%.6f,%.6f\n", r.iteration, r.moved, r.delta, r.mean_delta,
                  r.seconds);
    log += line;
  };
  const fpo::RemeshResult result = fpo::remesh(input, a.remesh);
  progress.erase();

  write_outputs(a, result, log);
  warn_if_not_homeomorphic(input, result.mesh);
  const fpo::OptimizeResult& o = result.optimization;
  std::printf(
      "samples %zu\niterations %d\nmoves %zu\nstopped %s\ndelta %.6f\nmean_delta %.6f\nseconds %.3f\nwrote "
      "%s\n",
      result.samples.size(), o.last.iteration, o.moves, name_of(o.reason), o.last.delta, o.last.mean_delta,
      o.last.seconds, a.output.c_str());
  return o.reason == fpo::StopReason::interrupted ? tools::exit_interrupted : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-remesh", argc, argv, remesh); }
