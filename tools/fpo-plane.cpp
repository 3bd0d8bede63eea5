// fpo-plane: blue-noise samples on a rectangle, periodic or not, by farthest point optimization (paper,
// section 3).

#include "fpo/plane/plane_angles.h"
#include "fpo/plane/plane_quality.h"
#include "fpo/shortest_edge.h"
#include "io/atomic_file.h"
#include "io/mesh_io.h"
#include "io/points.h"
#include "tools/interrupt.h"
#include "tools/plane_arguments.h"
#include "tools/plane_bounded.h"
#include "tools/plane_mesh.h"
#include "tools/plane_sizing_source.h"
#include "tools/run_log.h"
#include "tools/summary.h"

namespace {

/// Algorithm 1, after shortest edge removal and before angle optimization if these are asked for.
fpo::OptimizeResult optimize(const tools::PlaneArguments& a, fpo::PlaneDomain& domain) {
  if (a.ser) fpo::remove_shortest_edges(domain, {.interrupted = a.optimize.interrupted, .on_move = {}});
  const fpo::OptimizeResult result = fpo::optimize(domain, a.optimize);
  // What has not been optimized at all has too many bad angles to be mended one by one.
  if (a.optimize_angles && result.last.iteration > 0 && result.reason != fpo::StopReason::interrupted)
    fpo::optimize_angles(domain, {.interrupted = a.optimize.interrupted});
  return result;
}

/// The samples come last: where they are, all is.
void write_outputs(const tools::PlaneArguments& a, const fpo::PlaneDomain& domain, const std::string& log) {
  if (!a.log.empty()) io::write_file(a.log, log);
  if (a.writes_mesh()) {
    io::write_mesh(a.output, tools::mesh_of(domain));
  } else if (a.writes_svg()) {
    tools::draw_plane(domain, a.picture).save(a.output);
  } else {
    std::vector<geom::WeightedPoint2> points;
    for (const fpo::PlaneSample& sample : domain.samples())
      points.push_back({sample.position, sample.weight});
    io::write_points(a.output, points);
  }
}

int plane(tools::CommandLine& cli) {
  tools::interrupt_flag();
  tools::PlaneArguments a = tools::parse_plane_arguments(cli);
  if (a.bounded) return tools::run_bounded_plane(a, cli.seed(), cli.quiet());
  const geom::FlatTorus torus(a.period);
  const auto sizing = tools::make_plane_sizing(a, torus);
  // PlaneOptions and PlaneStart tell why.
  const bool uniform = sizing->is_uniform();
  a.optimize.scope = a.scope.value_or(uniform ? fpo::Scope::global : fpo::Scope::two_ring);
  a.optimize.order = fpo::best_visit_order(uniform);
  tools::stop_if_interrupted();
  const double factor = a.weight_factor.value_or(fpo::best_plane_weight_factor(a.optimize.scope));
  const fpo::PlaneDensity density(*sizing, torus);
  const auto start = fpo::initial_plane_samples(density, a.num_samples, cli.seed(),
                                                a.start.value_or(fpo::best_plane_start(uniform)));
  fpo::PlaneDomain domain(torus, *sizing, density.edge_length_scale(a.num_samples), start,
                          {.weight_factor = factor});

  tools::RunLog log(cli.quiet());
  log.attach(a.optimize, a.num_samples);
  const fpo::OptimizeResult result = optimize(a, domain);
  const bool interrupted = tools::interrupt_flag();  // maybe after the optimization
  write_outputs(a, domain, log.csv());
  const fpo::PlaneQuality q = fpo::plane_quality(domain);
  tools::Summary summary;
  summary.count("samples", a.num_samples);
  summary.count("iterations", static_cast<std::size_t>(result.last.iteration));
  summary.count("moves", result.moves);
  summary.number(uniform ? "delta" : "delta_of_wanted", q.delta, 6);
  summary.number(uniform ? "mean_delta" : "mean_delta_of_wanted", q.mean_delta, 6);
  summary.number("grading_slope", q.grading_slope, 4);
  summary.number("spacing_variation", q.spacing_variation, 4);
  summary.number("theta_min", q.min_angle, 3);
  summary.number("theta_min_avg", q.mean_min_angle, 3);
  summary.number("theta_max", q.max_angle, 3);
  summary.count("theta_lt30", q.angles_below_30);
  summary.count("hidden", q.hidden);
  summary.number("seconds", result.last.seconds, 3);
  summary.text("wrote", a.output.string());
  summary.print(a.json);
  return interrupted ? tools::exit_interrupted : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-plane", argc, argv, plane); }
