// fpo-plane: blue-noise samples on a periodic rectangle by farthest point optimization (paper, section 3).

#include <cstdio>

#include "fpo/curve_feature_size.h"
#include "fpo/image_sizing.h"
#include "fpo/plane_quality.h"
#include "fpo/shortest_edge.h"
#include "io/atomic_file.h"
#include "io/extension.h"
#include "io/pgm.h"
#include "io/points.h"
#include "io/polylines.h"
#include "tools/interrupt.h"
#include "tools/plane_arguments.h"
#include "tools/progress.h"

namespace {

/// What is wrong with the content of a file is said with its name.
template <class Make>
auto about_file(const std::string& name, Make&& make) {
  try {
    return make();
  } catch (const geom::InputError& error) {
    throw geom::InputError(name + ": " + error.what());
  }
}

std::unique_ptr<fpo::PlaneSizing> image_sizing(const tools::PlaneArguments& a, const geom::FlatTorus& torus) {
  io::GrayImage image = io::read_pgm(a.sizing);
  for (float& value : image.value) value = 1 - value;
  return about_file(a.sizing, [&] {
    return fpo::image_sizing({image.width, image.height, std::move(image.value)}, torus, a.num_samples,
                             {.gradation = a.gradation});
  });
}

std::unique_ptr<fpo::PlaneSizing> curve_sizing(const tools::PlaneArguments& a, const geom::FlatTorus& torus) {
  const std::vector<fpo::Polyline> curves = io::read_polylines(a.sizing);
  return about_file(a.sizing, [&] {
    const auto points = fpo::curve_feature_size(curves, torus, torus.period().minCoeff() / 1024);
    return fpo::feature_sizing(points, torus, a.num_samples, {.gradation = a.gradation});
  });
}

std::unique_ptr<fpo::PlaneSizing> make_sizing(const tools::PlaneArguments& a, const geom::FlatTorus& torus) {
  if (auto named = fpo::named_sizing(a.sizing, torus)) return named;
  const std::string extension = io::lower_extension(a.sizing);
  geom::require(extension == ".pgm" || extension == ".txt",
                "--sizing: '" + a.sizing +
                    "' is neither a .pgm image, a .txt file of curves, nor the name of a field (see --help)");
  return extension == ".pgm" ? image_sizing(a, torus) : curve_sizing(a, torus);
}

/// Algorithm 1, after shortest edge removal if asked for; the log gets a line an iteration.
fpo::OptimizeResult optimize(tools::PlaneArguments& a, fpo::PlaneDomain& domain, bool quiet,
                             std::string& log) {
  tools::Progress progress("optimizing", quiet);
  double delta = 0;
  const double total = std::max(1.0, double(a.num_samples) * a.optimize.max_iterations);
  a.optimize.interrupted = &tools::interrupt_flag();
  a.optimize.on_move = [&](std::size_t move) { progress.update(double(move) / total, delta); };
  a.optimize.on_iteration = [&](const fpo::IterationReport& r) {
    delta = r.delta;
    char line[160];
    std::snprintf(line, sizeof line, "%d,%zu,%.6f,%.6f,%.6f\n", r.iteration, r.moved, r.delta, r.mean_delta,
                  r.seconds);
    log += line;
  };
  if (a.ser) fpo::remove_shortest_edges(domain, {.interrupted = a.optimize.interrupted, .on_move = {}});
  return fpo::optimize(domain, a.optimize);
}

void write_outputs(const tools::PlaneArguments& a, const fpo::PlaneDomain& domain, const std::string& log) {
  if (a.writes_svg()) {
    tools::draw_plane(domain, a.picture).save(a.output);
  } else {
    std::vector<geom::WeightedPoint2> points;
    for (const fpo::PlaneSample& sample : domain.samples())
      points.push_back({sample.position, sample.weight});
    io::write_points(a.output, points);
  }
  if (!a.log.empty()) io::write_file(a.log, log);
}

int plane(tools::CommandLine& cli) {
  tools::PlaneArguments a = tools::parse_plane_arguments(cli);
  const geom::FlatTorus torus(a.period);
  const auto sizing = make_sizing(a, torus);
  a.optimize.scope = a.scope.value_or(sizing->is_uniform() ? fpo::Scope::global : fpo::Scope::two_ring);
  // PlaneOptions tells why the global variant wants heavier samples.
  const double factor = a.weight_factor.value_or(a.optimize.scope == fpo::Scope::global ? 0.75 : 2.0 / 3);
  const fpo::PlaneDensity density(*sizing, torus);
  const auto start = fpo::initial_plane_samples(density, a.num_samples, cli.seed(), a.start);
  fpo::PlaneDomain domain(torus, *sizing, density.edge_length_scale(a.num_samples), start,
                          {.weight_factor = factor});

  std::string log = "iteration,moved,delta,mean_delta,seconds\n";
  const fpo::OptimizeResult result = optimize(a, domain, cli.quiet(), log);
  write_outputs(a, domain, log);
  const fpo::PlaneQuality q = fpo::plane_quality(domain);
  std::printf(
      "samples %zu\niterations %d\nmoves %zu\ndelta %.6f\nmean_delta %.6f\ngrading_slope %.4f\n"
      "spacing_variation %.4f\ntheta_min %.3f\ntheta_min_avg %.3f\ntheta_max %.3f\ntheta_lt30 %zu\nhidden "
      "%zu\n"
      "seconds %.3f\nwrote %s\n",
      a.num_samples, result.last.iteration, result.moves, q.delta, q.mean_delta, q.grading_slope,
      q.spacing_variation, q.min_angle, q.mean_min_angle, q.max_angle, q.angles_below_30, q.hidden,
      result.last.seconds, a.output.c_str());
  return result.reason == fpo::StopReason::interrupted ? tools::exit_interrupted : tools::exit_done;
}

}  // namespace

int main(int argc, char** argv) { return tools::run("fpo-plane", argc, argv, plane); }
