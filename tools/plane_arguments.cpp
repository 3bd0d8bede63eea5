#include "tools/plane_arguments.h"

#include "fpo/plane/plane_sizing.h"
#include "io/atomic_file.h"
#include "io/extension.h"
#include "tools/interrupt.h"
#include "tools/numbers.h"
#include "tools/period.h"
#include "tools/shared_options.h"

namespace tools {
namespace {

std::string all_sizing_names() {
  std::string all;
  for (const std::string& name : fpo::sizing_names()) all += (all.empty() ? "" : ", ") + name;
  return all;
}

void declare_result(CommandLine& cli, PlaneArguments& a) {
  cli.group("Result");
  cli.integer(
      {.name = "count", .letter = 'n', .value = "COUNT", .help = "number of samples", .required = true},
      a.num_samples, fpo::least_plane_samples, 100'000'000);
  cli.path({.name = "output",
            .letter = 'o',
            .value = "OUT",
            .help = "the samples: .txt (x y [weight] a line) or .svg, or with their triangulation .off, .obj",
            .required = true},
           a.output);
  declare_log(cli, a.log);
  declare_json(cli, a.json);
  cli.flag({.name = "draw-triangulation", .help = "in .svg: the regular triangulation"},
           a.picture.triangulation);
  cli.flag({.name = "draw-cells", .help = "in .svg: the power cells"}, a.picture.cells);
  cli.flag({.name = "draw-disks", .help = "in .svg: the samples' disks"}, a.picture.disks);
  cli.flag({.name = "draw-sizing", .help = "in .svg: cells coloured by the wanted edge length"},
           a.picture.colour);
}

void declare_domain(CommandLine& cli, PlaneArguments& a) {
  cli.group("Domain");
  cli.custom({.name = "period", .value = "WxH", .help = "width and height", .standard = "1x1"},
             [&a](const std::string& text) { a.period = parse_period(text); });
  cli.text({.name = "sizing",
            .value = "KIND",
            .help = "IMAGE.pgm or .png (dark is dense), CURVES.txt (lines x y, a blank line between curves: "
                    "their local "
                    "feature size), or one of " +
                    all_sizing_names()},
           a.sizing);
  cli.number({.name = "gradation",
              .value = "G",
              .help = "of images and curves: edge lengths grow by at most G times the distance"},
             a.gradation, 0.01, 1);
  cli.choice({.name = "start",
              .value = "random|stratified",
              .help = "initial samples",
              .standard = "random if uniform, else stratified"},
             a.start, {{"random", fpo::PlaneStart::random}, {"stratified", fpo::PlaneStart::stratified}});
  cli.flag({.name = "bounded", .help = "a rectangle with a border, not a torus"}, a.bounded);
  cli.choice({.name = "corners",
              .value = "c|all",
              .help = "of --bounded: where farthest points may be, inside only or on the border too"},
             a.corners, {{"c", geom::CornerTypes::c_only}, {"all", geom::CornerTypes::all}});
}

void declare_optimization(CommandLine& cli, PlaneArguments& a, ScopeFlags& scope, bool& rest) {
  cli.group("Optimization");
  cli.integer({.name = "iterations", .value = "MAX", .help = "at most so many"}, a.optimize.max_iterations, 0,
              1'000'000);
  cli.number({.name = "target-delta", .value = "D", .help = "stop when delta exceeds it"},
             a.optimize.target_delta, 0, 2);
  cli.toggle({.name = "rest", .help = "do not move samples where the target is met already"}, rest);
  declare_shortest_edge_removal(cli, a.ser);
  scope.declare(cli, " (default if not uniform)", " (default if uniform)");
  cli.custom({.name = "weight-factor",
              .value = "C",
              .help = "weights are (C h)^2 for edge length h",
              .standard = "0.68, or 0.75 with --global"},
             [&a](const std::string& text) { a.weight_factor = parse_number(text, 0.01, 1); });
  cli.toggle({.name = "optimize-angles", .help = "mend angles below 32 degrees afterwards"},
             a.optimize_angles);
}

}  // namespace

bool PlaneArguments::writes_mesh() const {
  const std::string extension = io::lower_extension(output);
  return extension == ".off" || extension == ".obj";
}

bool PlaneArguments::writes_svg() const { return io::lower_extension(output) == ".svg"; }

PlaneArguments parse_plane_arguments(CommandLine& cli) {
  PlaneArguments a;
  ScopeFlags scope;
  bool rest = false;
  cli.describe(
      "", std::string("Spreads COUNT samples of blue noise over a rectangle, periodic unless --bounded. ") +
              interrupt_help);
  declare_result(cli, a);
  declare_domain(cli, a);
  declare_optimization(cli, a, scope, rest);
  cli.parse(0, 0);
  a.scope = scope.scope();
  if (a.bounded && a.start) throw UsageError("--start is for tori: --bounded has random initial samples");
  geom::require(a.writes_svg() || a.writes_mesh() || io::lower_extension(a.output) == ".txt",
                a.output.string() + ": use .txt, .svg, .off or .obj");
  const bool draws = a.picture.triangulation || a.picture.cells || a.picture.disks || a.picture.colour;
  if (draws && !a.writes_svg()) throw UsageError("--draw-... is for -o OUT.svg");
  a.optimize.seed = cli.seed();
  if (rest) a.optimize.rest_spacing = a.optimize.target_delta + fpo::rest_margin;
  for (const std::filesystem::path& path : {a.output, a.log})
    if (!path.empty()) io::require_writable(path);
  return a;
}

}  // namespace tools
