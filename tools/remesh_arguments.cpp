#include "tools/remesh_arguments.h"

#include <cmath>
#include <optional>
#include <set>

#include "fpo/features/feature_samples.h"
#include "io/atomic_file.h"
#include "io/mesh_io.h"
#include "io/points.h"
#include "tools/interrupt.h"
#include "tools/remesh_features.h"
#include "tools/remesh_quality.h"
#include "tools/remesh_sizing.h"
#include "tools/shared_options.h"

namespace tools {
namespace {

constexpr double least_tile_samples = 100;  // in fewer, hardly any could be moved

/// None: to be chosen. 0: no tiles.
std::optional<std::size_t> tile_samples_of(const std::string& text) {
  if (text == "auto") return {};
  if (text == "off") return 0;
  const double count = parse_number(text, least_tile_samples, 1e9);
  geom::require(count == std::floor(count), "must be a whole number: " + text);
  return static_cast<std::size_t>(count);
}

std::vector<std::pair<std::string, fpo::Method>> method_words() {
  std::vector<std::pair<std::string, fpo::Method>> words;
  for (const fpo::MethodFacts& m : fpo::methods()) words.emplace_back(m.name, m.method);
  return words;
}

/// "fpo|cvt"
std::string method_names() {
  std::string names;
  for (const fpo::MethodFacts& m : fpo::methods()) names += (names.empty() ? "" : "|") + std::string(m.name);
  return names;
}

/// "uniform, lfs (local feature size)"
std::string sizing_names() {
  std::string names;
  for (const fpo::SizingFacts& facts : fpo::sizings()) {
    if (!facts.name) continue;
    names += (names.empty() ? "" : ", ") + std::string(facts.name);
    if (*facts.help) names += " (" + std::string(facts.help) + ")";
  }
  return names;
}

void declare_farthest(CommandLine& cli, RemeshArguments& a) {
  std::vector<std::pair<std::string, fpo::Priority>> words;
  std::string names, help;
  for (const fpo::FarthestRule& rule : fpo::farthest_rules()) {
    words.emplace_back(rule.name, rule.priority);
    names += (names.empty() ? "" : "|") + std::string(rule.name);
    help += (help.empty() ? "which empty circle is the farthest point: " : "; ") + std::string(rule.name) +
            ": " + rule.help;
  }
  cli.choice({.name = "farthest", .value = names, .help = help}, a.remesh.surface.farthest, words);
}

/// "fpo 100, 40 unless the sizing is uniform; cvt 100"
std::string iterations_by_method() {
  std::string text;
  for (const fpo::MethodFacts& m : fpo::methods()) {
    text += (text.empty() ? "" : "; ") + std::string(m.name) + " " + std::to_string(m.iterations);
    if (m.adaptive_iterations != m.iterations)
      text += ", " + std::to_string(m.adaptive_iterations) + " unless the sizing is uniform";
  }
  return text;
}

/// How many samples is said in one way. True if by lengths.
bool check_number(const RemeshArguments& a) {
  const bool by_lengths = a.lengths.edge_length || a.lengths.error || a.lengths.radius;
  if (a.remesh.num_samples > 0 && by_lengths)
    throw UsageError("-n excludes --edge-length, --error and --radius");
  if (a.remesh.num_samples > 0) return false;
  if (!by_lengths && a.remesh.sizing != fpo::SizingKind::given)
    throw UsageError("-n COUNT is missing (or --edge-length, --error, or a --sizing file of lengths)");
  if (a.lengths.error && a.remesh.sizing != fpo::SizingKind::uniform)
    throw UsageError("--error and --sizing exclude each other");
  const bool disks = a.remesh.method == fpo::Method::mps || a.remesh.method == fpo::Method::cps;
  if (a.lengths.radius &&
      (!disks || a.lengths.edge_length || a.lengths.error || a.remesh.sizing != fpo::SizingKind::uniform))
    throw UsageError("--radius is for --method mps or cps, by itself");
  return true;
}

void add_examples(CommandLine& cli) {
  cli.example("bunny.obj -n 2000 -o out.obj", "exactly 2000 vertices, evenly spread");
  cli.example("bunny.obj --edge-length 0.01 -o out.ply --quality draft",
              "edges 0.01 long on average, in a hurry");
  cli.example("bunny.obj -n 6000 --sizing lfs -o out.obj --report out.html",
              "small triangles where the shape is small, and a page about the result");
  cli.example("scan.ply --repair -n 5000 --carry -o out.ply", "a broken scan with colours");
  cli.example("bunny.obj -n 2000 --points out.ply", "the samples alone");
}

/// What is settled when all has been read.
struct Unsettled {
  fpo::Effort effort = fpo::Effort::best;
  int iterations = -1;
  double target_delta = -1, weight_scale = 0, min_size = 0, max_size = 0;  ///< 0 or less: not given
  ScopeFlags scope;
};

void declare_result(CommandLine& cli, RemeshArguments& a) {
  cli.describe("INPUT",
               std::string("Remeshes a surface (obj, off, ply, stl) with COUNT samples of blue noise. ") +
                   interrupt_help);
  add_examples(cli);
  cli.group("Result");
  cli.integer(
      {.name = "count",
       .letter = 'n',
       .value = "COUNT",
       .help = "number of samples: exactly the vertices of OUT (with methods of Poisson disks about as many)",
       .standard = "by lengths"},
      a.remesh.num_samples, 1, 20'000'000);
  cli.custom({.name = "edge-length",
              .value = "L",
              .help = "instead of -n: as many samples as make edges of mean length L"},
             [&](const std::string& text) { a.lengths.edge_length = parse_number(text, 0, 1e300); });
  cli.custom({.name = "error",
              .value = "E",
              .help = "instead of -n: edges as short as INPUT's curvature takes to stay within about E of it "
                      "(at most L long)"},
             [&](const std::string& text) { a.lengths.error = parse_number(text, 0, 1e300); });
  cli.path({.name = "output",
            .letter = 'o',
            .value = "OUT",
            .help = "the remesh: .obj .off .ply .stl; may be left out with --points"},
           a.output);
  cli.path({.name = "points",
            .value = "OUT",
            .help = "the samples: .xyz, or .ply with normal, area of the cell, facet, wanted length (size), "
                    "weight and rank: those of the lowest ranks are a smaller set, well spread"},
           a.points);
}

void declare_other_outputs(CommandLine& cli, RemeshArguments& a) {
  cli.group("Result");
  cli.flag({.name = "carry",
            .help = "OUT (.obj .ply) has INPUT's vertex colours, scalar vertex properties and texture "
                    "coordinates"},
           a.carry);
  cli.output({.name = "map",
              .value = "OUT.txt",
              .help = "a line per vertex: three vertices of INPUT (from 1) and their weights"},
             a.map, {".txt"});
  cli.output({.name = "rpd", .value = "OUT.obj", .help = "the restricted power diagram, a group a cell"},
             a.rpd, {".obj"});
  cli.output({.name = "picture", .value = "OUT.svg", .help = "a drawing of the remesh"}, a.picture, {".svg"});
  declare_log(cli, a.log);
  cli.output({.name = "report",
              .value = "OUT.html",
              .help = "a page with pictures to turn, charts, spectrum and quality beside the paper's"},
             a.report, {".html", ".htm"});

  cli.flag({.name = "hausdorff", .help = "measure how far the remesh is from INPUT"}, a.hausdorff);
  declare_json(cli, a.json);

  declare_repair(cli, a.repair);
  cli.path(
      {.name = "repaired",
       .value = "OUT",
       .help = "INPUT as it was remeshed; facets and vertices of INPUT mean its own: .obj .off .ply .stl"},
      a.repaired);
}

void declare_method(CommandLine& cli, RemeshArguments& a, Unsettled& u) {
  cli.group("Optimization");
  cli.choice({.name = "method",
              .value = method_names(),
              .help = "farthest point optimization, or what the paper compares it with: centroidal Voronoi "
                      "tessellation, constrained, parallel, maximal or hierarchical Poisson-disk sampling, "
                      "capacity-constrained triangulation, variational blue noise (these without angle "
                      "optimization and improvement of fidelity unless asked for)"},
             a.remesh.method, method_words());
  cli.custom({.name = "quality",
              .value = "draft|good|best",
              .help = "how long: 5 iterations, until delta is .9, or as long as --iterations and "
                      "--target-delta say; later options win",
              .standard = "best"},
             [&](const std::string& text) { u.effort = effort_of(text); });
  cli.integer(
      {.name = "iterations",
       .value = "MAX",
       .help =
           "at most so many: of FPO; with cvt 5 of Lloyd's, then of L-BFGS; with vbs of L-BFGS; with ccst "
           "pairs of steps; with Poisson disks radii tried to come near COUNT",
       .standard = iterations_by_method()},
      u.iterations, 0, 1'000'000);
  cli.number({.name = "target-delta",
              .value = "D",
              .help = "stop when delta exceeds it",
              .standard = shortest(a.remesh.optimize.target_delta)},
             u.target_delta, 0, 2);
  cli.group("Lengths and features");
  cli.custom({.name = "radius",
              .value = "R",
              .help = "instead of -n, with --method mps or cps: the radius of the disks"},
             [&](const std::string& text) { a.lengths.radius = parse_number(text, 0, 1e300); });
  cli.group("Optimization");
  cli.toggle({.name = "rest",
              .help = "do not move samples that, like their neighbours, are as far from others as the target "
                      "asks: faster to a delta below .92, smaller mean"},
             a.choices.rest);
  declare_farthest(cli, a);
}

void declare_search(CommandLine& cli, RemeshArguments& a) {
  cli.group("Expert: optimization");
  cli.choice({.name = "corners",
              .value = "c|all",
              .help = "where the farthest point may lie: on type C corners as in the "
                      "paper, or on A and B too"},
             a.remesh.surface.corners, {{"c", geom::CornerTypes::c_only}, {"all", geom::CornerTypes::all}});
  cli.choice(
      {.name = "engine", .value = "search|triangulation", .help = "where neighbours come from; same result"},
      a.remesh.surface.engine,
      {{"search", fpo::Engine::search}, {"triangulation", fpo::Engine::triangulation}});
  cli.custom(
      {.name = "tiles",
       .value = "auto|off|COUNT",
       .help = "optimize the samples of one part of the surface at a time, COUNT at most, parts changing "
               "from round to round: as many at once as there are threads, which do not change the "
               "result; auto: 3000 if there are more than 6000 samples",
       .standard = "auto"},
      [&](const std::string& text) { a.choices.tile_samples = tile_samples_of(text); });
  cli.toggle({.name = "coarse-start",
              .help = "where INPUT has 30 facets a sample and more, all iterations but the last ten on a "
                      "coarser surface near it"},
             a.remesh.coarse_start);
}

void declare_sizing(CommandLine& cli, RemeshArguments& a, Unsettled& u) {
  cli.group("Lengths and features");
  cli.custom(
      {.name = "sizing",
       .value = "KIND",
       .help =
           "wanted edge lengths: " + sizing_names() +
           ", or a file: a number per vertex of INPUT, a vertex property FILE.ply:NAME (value, if none is "
           "named), or a gray image (dark is dense) by INPUT's vt; ratios with -n, without it lengths",
       .standard = "uniform"},
      [&](const std::string& text) { set_sizing(a, text); });
  cli.number({.name = "gradation", .value = "G", .help = "the wanted length changes by at most G per length"},
             a.remesh.limits.gradation, 0.001, 10);
  cli.group("Expert: optimization");
  cli.number({.name = "weight-scale",
              .value = "C",
              .help = "a sample's weight is (C wanted length)^2",
              .standard = "2/3 if local, .75 if global"},
             u.weight_scale, 0.01, 2);
  cli.group("Lengths and features");
  cli.number({.name = "min-size",
              .value = "R",
              .help = "least wanted length, in units of the even spacing",
              .standard = "0.1, none by lengths"},
             u.min_size, 1e-6, 1);
  cli.number({.name = "max-size",
              .value = "R",
              .help = "greatest wanted length, likewise",
              .standard = "10, none by lengths"},
             u.max_size, 1, 1e6);
  cli.output({.name = "sizing-out",
              .value = "FILE",
              .help = "the wanted length at each vertex of INPUT; .ply: INPUT coloured by it"},
             a.sizing_out, {".txt", ".ply"});
}

void declare_features(CommandLine& cli, RemeshArguments& a) {
  cli.group("Lengths and features");
  set_features(a, "auto");
  cli.custom(
      {.name = "features",
       .value = "LIST",
       .help = "keep borders, corners and creases: auto (those of machined parts), none, or an ANGLE (folds "
               "by more degrees); after a comma also seams (of texture coordinates), groups (their borders), "
               "lines (OBJ l) or a FILE of polylines along edges (lines \"x y z\")",
       .standard = "auto"},
      [&](const std::string& text) { set_features(a, text); });
  cli.path({.name = "fixed", .value = "FILE", .help = "points of the surface to be vertices: .xyz .ply"},
           a.fixed_file);
  cli.group("Result");
  cli.flag({.name = "strict", .help = "exit code 3 if the remesh is not of INPUT's topological type"},
           a.strict);
  cli.flag({.name = "at-least",
            .help = "use more than COUNT samples, about as many as it takes, if the remesh would not be of "
                    "INPUT's topological type"},
           a.at_least);
}

void declare_mending(CommandLine& cli, RemeshArguments& a, Unsettled& u) {
  cli.group("Expert: optimization");
  declare_shortest_edge_removal(cli, a.remesh.shortest_edge_removal);
  cli.toggle({.name = "optimize-angles", .help = "angle optimization afterwards", .standard = "on with fpo"},
             a.choices.optimize_angles);
  cli.group("Optimization");
  cli.custom(
      {.name = "min-angle",
       .value = "A",
       .help = "smallest angle that angle optimization wants, in degrees; the largest is 156 - 4A/3",
       .standard = "33"},
      [&](const std::string& text) { fpo::set_least_angle(a.remesh.angles, parse_number(text, 1, 45)); });
  cli.custom({.name = "min-delta",
              .value = "D",
              .help = "angle optimization, improvement of fidelity and --closer lower delta to this, not "
                      "further: what one gains the other pays",
              .standard = "0.915, --closer 0.88"},
             [&](const std::string& text) {
               a.remesh.angles.enough_delta = a.remesh.closer_delta = parse_number(text, 0, 1);
             });
  cli.group("Expert: optimization");
  cli.toggle({.name = "improve-fidelity",
              .help = "mend triangles that are far from the surface",
              .standard = "on with fpo"},
             a.choices.improve_fidelity);
  cli.toggle({.name = "closer",
              .help = "then bring the remesh closer to INPUT, both ways, as far as delta stays above what "
                      "--min-delta says",
              .standard = "for a while, with the quality best, where lengths are even and no features kept"},
             a.choices.come_closer);
  cli.choice(
      {.name = "sheets",
       .value = "auto|apart|together",
       .help = "sheets nearer than samples: apart, as the paper's diagram has them, or apart where that "
               "mends the type or small angles"},
      a.remesh.sheets,
      {{"auto", fpo::Sheets::automatic}, {"apart", fpo::Sheets::apart}, {"together", fpo::Sheets::together}});
  cli.flag(
      {.name = "maximal",
       .help = "in the end move samples until the disks that reach to their neighbours cover the surface"},
      a.remesh.maximal);
  cli.toggle({.name = "mend", .help = "bring samples to where the remesh is no surface"}, a.remesh.mend);
  u.scope.declare(cli, "", "");
}

void parse(CommandLine& cli, RemeshArguments& a) {
  Unsettled u;
  declare_result(cli, a);
  declare_other_outputs(cli, a);
  declare_method(cli, a, u);
  declare_search(cli, a);
  declare_sizing(cli, a, u);
  declare_features(cli, a);
  declare_mending(cli, a, u);
  a.input = cli.parse(1, 1).front();
  check_repair(a.repair);
  fpo::Choices& choices = a.choices;
  choices.scope = u.scope.scope();
  if (u.weight_scale > 0) choices.weight_factor = u.weight_scale;
  if (u.iterations >= 0) choices.iterations = u.iterations;
  use_quality(a, u.effort, u.target_delta);
  geom::require(a.remesh.method == fpo::Method::fpo ||
                    !(a.remesh.shortest_edge_removal || choices.scope || choices.rest),
                "--ser, --local, --global and --rest work with --method fpo only");
  const bool by_lengths = check_number(a);
  if (by_lengths) a.remesh.limits = {a.remesh.limits.gradation, 1e-6, 1e6};
  if (u.min_size > 0) a.remesh.limits.smallest = u.min_size;
  if (u.max_size > 0) a.remesh.limits.largest = u.max_size;
  a.remesh.seed = cli.seed();
  a.remesh.threads = cli.threads();
  const bool areas = !a.points.empty() && io::point_format(a.points) == io::PointFormat::ply;
  a.remesh.keep_cells = !a.rpd.empty() || !a.report.empty() || areas;
}

/// Refuses bad output names before the work starts.
void check_outputs(const RemeshArguments& a) {
  if (a.output.empty() && a.points.empty()) throw UsageError("-o OUT is missing (or --points OUT)");
  if (!a.output.empty()) io::mesh_format(a.output);
  if (!a.repaired.empty()) io::mesh_format(a.repaired);
  if (!a.points.empty())
    geom::require(io::point_format(a.points) != io::PointFormat::txt,
                  a.points.string() + ": use .xyz or .ply");
  std::set<std::filesystem::path> taken;
  for (const std::filesystem::path& path :
       {a.output, a.points, a.rpd, a.log, a.picture, a.sizing_out, a.map, a.report, a.repaired}) {
    if (path.empty()) continue;
    io::require_writable(path);
    std::error_code gone;  // the folder, meanwhile: then writing will tell
    const std::filesystem::path file =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path), gone);
    geom::require(gone || taken.insert(file).second, path.string() + ": named for two outputs");
  }
}

}  // namespace

RemeshArguments parse_remesh_arguments(CommandLine& cli) {
  RemeshArguments a;
  parse(cli, a);
  check_outputs(a);
  return a;
}

void read_files(RemeshArguments& a, const geom::TriMesh& input) {
  if (!a.fixed_file.empty()) {
    for (const geom::WeightedPoint3& point : io::read_points3(a.fixed_file))
      a.remesh.fixed.push_back(point.position);
    try {
      fpo::points_on_surface(input, a.remesh.fixed);
    } catch (const geom::InputError& error) {
      throw geom::InputError(a.fixed_file.string() + ": " + error.what());
    }
  }
}

}  // namespace tools
