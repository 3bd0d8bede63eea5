#include "tools/remesh_report.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "fpo/spectrum/spectrum_set.h"
#include "geom/mesh/scaling.h"
#include "geom/mesh/vertex_clusters.h"
#include "io/html_report.h"
#include "tools/measures.h"
#include "tools/measures_table.h"
#include "tools/picture_of_spectrum.h"
#include "tools/progress.h"
#include "tools/report_charts.h"
#include "tools/report_scenes.h"
#include "tools/type_warnings.h"
#include "tools/worded.h"

namespace tools {
namespace {

constexpr std::size_t most_spectrum_samples = 15'000;
constexpr std::size_t most_still_facets = 20'000;             // some 600 KB
constexpr double pictures_share = 0.2, measures_share = 0.5;  // of the time that a report takes

/// The spectrum takes some 4 to 8 us a sample times the square of its radius, an iteration some 8 us a
/// sample: chosen so that a report takes no longer than the remesh. fpo-spectrum looks farther.
double spectrum_radius(int iterations) { return std::clamp(0.6 * std::sqrt(iterations), 4.0, 6.0); }
constexpr double spectrum_detail = 0.5;

/// The result in units in which no square under- or overflows.
fpo::RemeshResult scaled(const fpo::RemeshResult& result, double factor) {
  fpo::RemeshResult r = result;
  r.mesh = geom::scaled(result.mesh, factor);
  for (fpo::SurfaceSample& x : r.samples) x.position *= factor;
  for (geom::Vec3& place : r.advice.places) place *= factor;
  for (double& h : r.sizing) h *= factor;
  for (double& h : r.wanted) h *= factor;
  for (fpo::CellPolygon& cell : r.cells)
    for (geom::Vec3& corner : cell.corners) corner *= factor;
  return r;
}

std::string number(double value, const char* format = "%.6g") { return worded(format, value); }

io::HtmlTable run_table(const fpo::RemeshResult& result, const RemeshRun& run, const Measures& measures) {
  const fpo::OptimizeResult& o = result.optimization;
  const bool uniform = run.options.sizing == fpo::SizingKind::uniform;
  const double delta = uniform ? measures.quality.delta : result.measures.delta;
  const double mean_delta = uniform ? measures.quality.delta_avg : result.measures.mean_delta;
  io::HtmlTable table;
  table.words = true;
  table.rows = {
      {{"version", FPO_VERSION}},
      {{"input", run.input.string()}},
      {{"method", fpo::facts_of(run.options.method).acronym}},
      {{"samples", std::to_string(result.samples.size())}},
      {{"sizing", fpo::facts_of(run.options.sizing).title}},
      {{"seed", std::to_string(run.options.seed)}},
      {{"search for farthest points",
        run.options.optimize.scope == fpo::Scope::global ? "everywhere" : "nearby"}},
      {{"iterations", std::to_string(o.last.iteration)}},
      {{"moves", std::to_string(o.moves)}},
      {{"samples on features or fixed", std::to_string(result.feature_samples)}},
      {{"feature edges, broken",
        std::to_string(result.feature_edges) + ", " + std::to_string(result.broken_feature_edges)}},
      {{"bad triangles before, after angle optimization",
        std::to_string(result.angles.bad_before) + ", " + std::to_string(result.angles.bad_after)}},
      {{uniform ? "delta, mean delta of the mesh" : "delta, mean delta of wanted lengths",
        number(delta, "%.4f") + ", " + number(mean_delta, "%.4f")}},
      {{"variation of length / wanted length", number(result.fit.cv, "%.4f")}},
      {{"seconds, threads", number(run.seconds, "%.3f") + " (optimization " + number(o.last.seconds, "%.3f") +
                                "), " + std::to_string(run.threads)}}};
  if (!uniform)
    table.rows.push_back(
        {{"slope of log length against log wanted length", number(result.fit.slope, "%.4f")}});
  return table;
}

void add_spectrum(io::HtmlReport& page, const geom::TriMesh& input, const fpo::RemeshResult& result,
                  const RemeshRun& run, const std::function<void(double)>& tell) {
  page.heading("Spectrum");
  if (result.samples.size() > most_spectrum_samples || result.samples.size() < 2) {
    page.note("Left out: it takes long for more than " + std::to_string(most_spectrum_samples) +
              " samples. fpo-spectrum computes it for any number.");
    return;
  }
  const bool uniform = run.options.sizing == fpo::SizingKind::uniform;
  std::vector<geom::WeightedPoint3> points;
  for (std::size_t i = 0; i < result.samples.size(); ++i)
    points.push_back({result.samples[i].position, std::pow(result.wanted[geom::VertexId(i)], 2)});
  const double radius = spectrum_radius(result.optimization.last.iteration);
  const fpo::SpectrumOptions options{.radius = radius, .threads = run.threads, .on_progress = tell};
  const fpo::SpectrumSurface surface(input);
  const fpo::SpacingRule rule = uniform ? fpo::SpacingRule::uniform : fpo::SpacingRule::weights;
  MeanSpectrum mean;
  mean.spectrum = fpo::differential_spectrum(
      fpo::surface_set(std::span<const geom::WeightedPoint3>(points), surface, rule, spectrum_detail),
      options);
  mean.curve = fpo::radial_curve(mean.spectrum, fpo::ring_width(options));
  const std::vector<io::HtmlPlot> plots = {
      {draw_spectrum(mean),
       "Of this one set, by differential domain analysis with radius " + number(radius, "%.2g") +
           "; black is no power, mid gray that of white noise. fpo-spectrum resolves more."}};
  page.plots(plots);
}

void add_measures(io::HtmlReport& page, const Measures& measures, const RemeshRun& run) {
  page.heading("Quality");
  page.table(quality_table(run.input.stem().string(), run.options, measures));
  page.note(
      "Q: 1 for an equilateral triangle; theta: angles in degrees; V567: interior vertices with 5, 6 or 7 "
      "edges; "
      "d_H: Hausdorff distance in percent of the input's diagonal. Methods other than this run: as the paper "
      "prints them.");
  const fpo::Covering& c = measures.covering;
  page.note(
      "The largest empty circle of the input, with centers anywhere on it, has " + number(c.ratio, "%.4f") +
      " times the least distance of two samples for its radius; disks of " + number(c.local_ratio, "%.4f") +
      " times each sample's distance to the nearest other one cover the input. A set is a maximal "
      "Poisson-disk set where that is at most 1: uniform sets in the first, adaptive ones in the second "
      "sense.");
  io::HtmlTable all;
  for (const auto& [name, value] : named(measures)) all.rows.push_back({{name, number(value, "%.9g")}});
  page.folded("All measures", all);
  page.data("measures", json(named(measures)));
}

}  // namespace

void write_remesh_report(const std::filesystem::path& path, const geom::TriMesh& input,
                         const fpo::RemeshResult& result, const RemeshRun& run) {
  Progress progress("report", run.quiet);
  const auto tell = [&](double done) {
    progress.update(done, run.iterations.empty() ? 0 : run.iterations.back().delta);
  };
  tell(0);
  const double factor = geom::factor_to_unit_box(input);
  const geom::TriMesh surface = geom::scaled_to_unit_box(input, factor);
  const fpo::RemeshResult drawn = scaled(result, factor);

  io::HtmlReport page(run.input.stem().string() + ", " + std::to_string(result.samples.size()) + " samples");
  page.command(run.command);
  for (const std::string& line : type_warnings(input, result, run.options)) page.banner(line + ".");
  for (const std::string& line : shape_warnings(input, result, run.options)) page.banner(line + ".");
  page.note(
      "Turn the pictures by dragging or with the arrow keys, shift them with the shift key or the other "
      "button "
      "held; zoom with + and - or two fingers; 0 sets back.");
  const io::SceneView view;
  io::MeshPicture still;
  const geom::TriMesh coarse = geom::with_fewer_facets(drawn.mesh, most_still_facets);
  still.back_faces = geom::topology(coarse).boundary_edges > 0;
  page.scenes(remesh_scenes({surface, run.options, drawn, result.sizing, 1 / factor}, view), view,
              io::draw_mesh(coarse, still));
  page.heading("Triangles");
  const geom::Vec2 size(360, 260);
  const std::vector<io::HtmlPlot> plots = {
      {io::draw_chart(angle_histogram(drawn.mesh), size)},
      {io::draw_chart(length_histogram(drawn.mesh, drawn.wanted), size)},
      {io::draw_chart(convergence_chart(run.iterations), size), "delta (blue) and its mean (red)."}};
  page.plots(plots);
  tell(pictures_share);
  const auto between = [&](double from, double to) {
    return [=](double share) { tell(from + share * (to - from)); };
  };
  const Measures measures = measure(result.mesh, input, run.threads, between(pictures_share, measures_share));
  add_measures(page, measures, run);
  tell(measures_share);
  add_spectrum(page, surface, drawn, run, between(measures_share, 1));
  page.heading("Run");
  page.table(run_table(result, run, measures));
  page.save(path);
}

}  // namespace tools
