// Where shortest edge removal pays: CPU time until sets are equally good (figure 11 of the paper, right).
//   bench-ser [MODEL N]...   by default eight 1700 and homer 7900; models are files NAME.obj in the folder
//   named by FPO_MODELS (default ../shared/models), those that are missing are named
// For the torus and for each model, uniform and adaptive, and for four ways: the milliseconds from random
// samples, their diagram included, to each mean delta, delta and Q_avg. Between two iterations the time is
// interpolated; "-" where 40 iterations do not come there. The measuring itself does not count.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "fpo/measure/quality.h"
#include "fpo/plane/plane_domain.h"
#include "fpo/remesh/extract.h"
#include "fpo/surface/initial_samples.h"
#include "fpo/surface/sizing_kinds.h"
#include "fpo/surface/surface_domain.h"
#include "io/mesh_io.h"
#include "tests/bench/models.h"
#include "tools/convergence.h"
#include "tools/worded.h"

namespace {

constexpr int most_iterations = 40;
constexpr std::array<double, 3> mean_deltas = {0.85, 0.87, 0.9}, deltas = {0.75, 0.8, 0.88};
constexpr std::array<double, 3> q_avgs = {0.83, 0.84, 0.85};

/// The milliseconds of a set, and its Q_avg.
struct Course {
  explicit Course(const tools::Convergence& c, std::size_t n)
      : milliseconds(c.microseconds), mean_delta(c.mean_delta), delta(c.delta), q_avg(c.measured) {
    for (double& time : milliseconds) time *= 1e-3 * static_cast<double>(n);
  }
  std::vector<double> milliseconds, mean_delta, delta, q_avg;
};

Course course(fpo::Domain& domain, const tools::Way& way, fpo::VisitOrder order, double start,
              const std::function<double()>& q_avg) {
  tools::ConvergenceOptions options;
  options.iterations = most_iterations;
  options.order = order;
  options.measure = q_avg;
  return Course(converge(domain, way, start, options), domain.num_samples());
}

/// When the values first come to that one.
std::string time_to(const Course& c, const std::vector<double>& values, double wanted) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < wanted) continue;
    const double part = i == 0 ? 0 : (wanted - values[i - 1]) / (values[i] - values[i - 1]);
    const double time = i == 0 ? c.milliseconds[0]
                               : c.milliseconds[i - 1] + part * (c.milliseconds[i] - c.milliseconds[i - 1]);
    return tools::worded("%.0f", time);
  }
  return "-";
}

void row(const std::string& name, const Course& c) {
  std::printf("%-34s", name.c_str());
  for (const double wanted : mean_deltas) std::printf(" %7s", time_to(c, c.mean_delta, wanted).c_str());
  for (const double wanted : deltas) std::printf(" %7s", time_to(c, c.delta, wanted).c_str());
  for (const double wanted : q_avgs) std::printf(" %7s", time_to(c, c.q_avg, wanted).c_str());
  std::printf("  %.3f %.3f %.4f\n", c.mean_delta.back(), c.delta.back(), c.q_avg.back());
  std::fflush(stdout);
}

/// Of the triangles of the torus, each by itself.
double q_avg_of(const geom::Regular2& triangulation) {
  geom::Table<geom::VertexId, geom::Vec3> vertices;
  geom::Table<geom::FacetId, geom::TriMesh::Facet> facets;
  for (const auto& corner : triangulation.triangles()) {
    const geom::VertexId first(vertices.size());
    facets.push_back({first, geom::VertexId(first.index() + 1), geom::VertexId(first.index() + 2)});
    vertices.push_back({0, 0, 0});
    for (const std::size_t k : {1, 2}) {
      const geom::Vec2 apart = triangulation.difference(corner[0], corner[k]);
      vertices.push_back({apart.x(), apart.y(), 0});
    }
  }
  return fpo::quality(geom::TriMesh(std::move(vertices), std::move(facets)), 1).q_avg;
}

void plane(const std::string& field, std::size_t n) {
  const geom::FlatTorus torus({1, 1});
  const auto sizing = fpo::named_sizing(field, torus);
  const fpo::PlaneDensity density(*sizing, torus);
  const auto samples = fpo::initial_plane_samples(density, n, 1);
  for (const tools::Way& way : tools::ways) {
    const double start = tools::thread_seconds();
    fpo::PlaneDomain domain(torus, *sizing, density.edge_length_scale(n), samples,
                            {.weight_factor = fpo::best_plane_weight_factor(way.scope)});
    row("torus " + field + " " + std::to_string(n) + " " + way.name,
        course(domain, way, fpo::best_visit_order(field == "uniform"), start,
               [&] { return q_avg_of(domain.triangulation()); }));
  }
}

void surface(const geom::TriMesh& mesh, const std::string& model, std::size_t n, bool adaptive) {
  const double spacing = fpo::hexagonal_spacing(mesh.area(), n);
  const auto rho_of = fpo::facts_of(fpo::SizingKind::local_feature_size).rho;
  const fpo::Sizing sizing =
      adaptive ? fpo::fit_sizing(mesh, rho_of({mesh, n, spacing, {}}), n) : fpo::Sizing::uniform(spacing);
  const auto samples = fpo::random_samples(mesh, sizing, n, 1);
  for (const tools::Way& way : tools::ways) {
    const double start = tools::thread_seconds();
    fpo::SurfaceDomain domain(mesh, sizing, samples, {.weight_factor = fpo::best_weight_factor(way.scope)});
    row(model + (adaptive ? " lfs " : " uniform ") + std::to_string(n) + " " + way.name,
        course(domain, way, fpo::VisitOrder::shuffled, start,
               [&] { return fpo::quality(fpo::extract(*domain.diagram(), n), mesh.area()).q_avg; }));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::pair<std::string, std::size_t>> models = {{"eight", 1700}, {"homer", 7900}};
  if (argc > 2) models.clear();
  for (int i = 1; i + 1 < argc; i += 2) models.emplace_back(argv[i], std::strtoull(argv[i + 1], nullptr, 10));

  std::printf("%-34s", "ms to");
  for (const double x : mean_deltas) std::printf("  d~ %.2f", x);
  for (const double x : deltas) std::printf("  d  %.2f", x);
  for (const double x : q_avgs) std::printf("  Q  %.2f", x);
  std::printf("  d~, d, Q after %d iterations\n", most_iterations);
  for (const std::size_t n : {1000, 4000, 16000})
    for (const char* field : {"uniform", "waves5"}) plane(field, n);
  for (const auto& [model, n] : models) {
    const auto file = bench::model_file(model);
    if (!std::filesystem::exists(file)) {
      std::printf("missing: %s\n", file.c_str());
      continue;
    }
    const geom::TriMesh mesh = io::read_mesh(file);
    for (const bool adaptive : {false, true}) surface(mesh, model, n, adaptive);
  }
}
