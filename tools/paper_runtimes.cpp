#include "tools/paper_runtimes.h"

#include <algorithm>
#include <array>

#include "fpo/plane/plane_domain.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/local_feature_size.h"
#include "fpo/surface/surface_domain.h"

namespace tools {
namespace {

constexpr std::array<std::size_t, 5> sizes = {1000, 2000, 5000, 10000, 20000};

}  // namespace

RuntimeJobs::RuntimeJobs(const geom::TriMesh* surface, std::uint64_t seed) : surface_(surface), seed_(seed) {
  for (const bool on_surface : {false, true}) {
    if (on_surface && !surface) continue;
    for (const bool adaptive : {false, true})
      for (const Part part : {Part::iteration, Part::without_removal, Part::with_removal})
        for (const std::size_t n : sizes)
          if (adaptive || part == Part::iteration) jobs_.push_back({on_surface, adaptive, part, n});
  }
  if (!surface) return;
  const double spacing = fpo::hexagonal_spacing(surface->area(), sizes.back());
  feature_size_ = fpo::local_feature_size(*surface, {.spacing = spacing / 2});
  for (double& value : feature_size_) value = std::max(value, 1e-6 * spacing);
}

void RuntimeJobs::run(std::size_t job) {
  if (jobs_[job].on_surface)
    run_on_surface(jobs_[job]);
  else
    run_in_plane(jobs_[job]);
}

double RuntimeJobs::cost(std::size_t job) const {
  const Job& j = jobs_[job];
  return static_cast<double>(j.samples) * (j.on_surface ? 20 : 1) * (j.part == Part::iteration ? 2 : 20) / 20;
}

std::string RuntimeJobs::name(std::size_t job) const {
  const Job& j = jobs_[job];
  const std::string part = j.part == Part::iteration         ? "one iteration"
                           : j.part == Part::without_removal ? "without SER"
                                                             : "with SER";
  return std::string("runtime ") + (j.on_surface ? "surface" : "plane") +
         (j.adaptive ? " adaptive " : " uniform ") + std::to_string(j.samples) + " " + part;
}

void RuntimeJobs::measure(fpo::Domain& domain, double start, Job& job) const {
  ConvergenceOptions options;
  if (!job.on_surface) options.order = fpo::best_visit_order(!job.adaptive);
  if (job.part == Part::iteration) {
    options.iterations = 2;
    const std::vector<double> times = converge(domain, ways[0], start, options).microseconds;
    job.seconds = 1e-6 * static_cast<double>(job.samples) * (times[2] - times[1]);
    return;
  }
  options.iterations = most_iterations;
  options.enough_mean_delta = enough_mean_delta;
  const Way& way = job.part == Part::with_removal ? ways[3] : ways[0];
  const Convergence c = converge(domain, way, start, options);
  job.seconds = 1e-6 * static_cast<double>(job.samples) * c.microseconds.back();
  job.removal_seconds = c.removal_seconds;
}

void RuntimeJobs::run_in_plane(Job& job) const {
  const geom::FlatTorus torus({1, 1});
  const auto sizing = fpo::named_sizing(job.adaptive ? "waves5" : "uniform", torus);
  const fpo::PlaneDensity density(*sizing, torus);
  const auto samples = fpo::initial_plane_samples(density, job.samples, seed_);
  const fpo::Scope scope = job.part == Part::with_removal ? fpo::Scope::two_ring : fpo::Scope::global;
  const double start = thread_seconds();
  fpo::PlaneDomain domain(torus, *sizing, density.edge_length_scale(job.samples), samples,
                          {.weight_factor = fpo::best_plane_weight_factor(scope)});
  measure(domain, start, job);
}

void RuntimeJobs::run_on_surface(Job& job) const {
  const fpo::Sizing sizing =
      job.adaptive ? fpo::fit_sizing(*surface_, feature_size_, job.samples)
                   : fpo::Sizing::uniform(fpo::hexagonal_spacing(surface_->area(), job.samples));
  const auto samples = fpo::random_samples(*surface_, sizing, job.samples, seed_);
  const fpo::Scope scope = job.part == Part::with_removal ? fpo::Scope::two_ring : fpo::Scope::global;
  const double start = thread_seconds();
  fpo::SurfaceDomain domain(*surface_, sizing, samples, {.weight_factor = fpo::best_weight_factor(scope)});
  measure(domain, start, job);
}

RuntimeCurve RuntimeJobs::curve(const std::string& figure, const Job& like, double Job::*value) const {
  RuntimeCurve result;
  result.figure = figure;
  const std::string where = like.on_surface ? "Surf_" : "2D_";
  result.name = where + (figure == "10 right"              ? (like.adaptive ? "AFPO" : "UFPO")
                         : figure == "11 left"             ? "ASER"
                         : like.part == Part::with_removal ? "SER"
                                                           : "noSER");
  for (const Job& j : jobs_)
    if (j.on_surface == like.on_surface && j.adaptive == like.adaptive && j.part == like.part)
      result.points.push_back({static_cast<double>(j.samples), j.*value});
  return result;
}

std::vector<RuntimeCurve> RuntimeJobs::curves() const {
  std::vector<RuntimeCurve> result;
  for (const bool on_surface : {false, true}) {
    if (on_surface && !surface_) continue;
    for (const bool adaptive : {false, true})
      result.push_back(curve("10 right", {on_surface, adaptive, Part::iteration, 0}, &Job::seconds));
    const Job with{on_surface, true, Part::with_removal, 0},
        without{on_surface, true, Part::without_removal, 0};
    result.push_back(curve("11 left", with, &Job::removal_seconds));
    result.push_back(curve("11 right", with, &Job::seconds));
    result.push_back(curve("11 right", without, &Job::seconds));
  }
  return result;
}

io::Chart runtimes_chart(const std::vector<RuntimeCurve>& curves, const std::string& figure) {
  const std::array<const char*, 4> colours = {"#1d4f91", "#2a8a57", "#c0392b", "#d98a00"};
  io::Chart chart{"Figure " + figure,
                  {"samples", 900, 25000, io::Axis::Scale::logarithmic},
                  {"CPU seconds", 0, 0, io::Axis::Scale::logarithmic},
                  {},
                  {}};
  for (const RuntimeCurve& c : curves) {
    if (c.figure != figure) continue;
    io::Series series{c.points, c.name};
    series.colour = colours[chart.series.size() % colours.size()];
    chart.series.push_back(series);
  }
  return chart;
}

}  // namespace tools
