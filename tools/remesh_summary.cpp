#include "tools/remesh_summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fpo/measure/quality.h"
#include "fpo/remesh/effort.h"
#include "geom/mesh/scaling.h"
#include "tools/feature_words.h"
#include "tools/interrupt.h"

namespace tools {
namespace {

constexpr double uneven = 0.999;  // the shortest of lengths over the longest

const char* name_of(fpo::StopReason reason, const RemeshRun& run) {
  switch (reason) {
    case fpo::StopReason::target_reached:
      return "target_reached";
    case fpo::StopReason::nothing_moved:
      return "nothing_moved";
    case fpo::StopReason::nothing_gained:
      return "converged";
    case fpo::StopReason::iteration_cap:
      return fpo::stopped_gaining(run.iterations) ? "converged" : "iteration_cap";
    case fpo::StopReason::interrupted:
      return "interrupted";
  }
  return "unknown";
}

/// In the unit box, where no square of a length under- or overflows. The mean edge is scaled back.
struct Shape {
  fpo::Quality quality;
  double mean_edge = 0;
};

Shape shape_of(const geom::TriMesh& input, const geom::TriMesh& output) {
  if (output.num_facets() == 0) return {};
  const double factor = geom::factor_to_unit_box(input);
  const geom::TriMesh mesh = geom::scaled(output, factor);
  double sum = 0, weights = 0;  // an inner edge counts half in each of its facets
  for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const double weight = mesh.across(t, e).valid() ? 0.5 : 1;
      sum += weight * (mesh.corner(t, e) - mesh.corner(t, (e + 1) % 3)).norm();
      weights += weight;
    }
  return {fpo::quality(mesh, geom::scaled(input, factor).area()), sum / weights / factor};
}

/// In spacings of all vertices, as fpo-quality has it, or in the lengths wanted of those that are not fixed.
struct Spacing {
  bool uniform;
  double delta, mean_delta;
};

Spacing spacing_of(const RemeshArguments& a, const fpo::RemeshResult& result, const Shape& shape) {
  if (a.remesh.sizing != fpo::SizingKind::uniform)
    return {false, result.measures.delta, result.measures.mean_delta};
  return {true, shape.quality.delta, shape.quality.delta_avg};
}

void add_run(Summary& s, const RemeshArguments& a, const fpo::RemeshResult& result, const RemeshRun& run,
             const Spacing& spacing) {
  const fpo::OptimizeResult& o = result.optimization;
  const bool interrupted = interrupt_flag();  // maybe after the optimization
  s.count("samples", result.samples.size());
  s.count("iterations", static_cast<std::size_t>(o.last.iteration));
  s.count("moves", o.moves);
  s.text("stopped", name_of(interrupted ? fpo::StopReason::interrupted : o.reason, run));
  s.number(spacing.uniform ? "delta" : "delta_of_wanted", spacing.delta, 6);
  s.number(spacing.uniform ? "mean_delta" : "mean_delta_of_wanted", spacing.mean_delta, 6);
  s.number("seconds", o.last.seconds, 3);
  s.text("wrote", (a.output.empty() ? a.points : a.output).string());
}

/// Smallest, median and largest wanted length, and how many samples want which.
void add_sizing(Summary& s, const fpo::RemeshResult& result) {
  std::vector<double> h(result.sizing.begin(), result.sizing.end());
  std::ranges::sort(h);
  s.number("h_min", h.front(), -1);
  s.number("h_median", h[h.size() / 2], -1);
  s.number("h_max", h.back(), -1);
  s.number("size_slope", result.fit.slope, 4);
  s.number("size_cv", result.fit.cv, 4);
  s.count("hidden", result.hidden);
  std::map<int, std::size_t> decades;
  for (const double value : result.wanted) ++decades[static_cast<int>(std::floor(std::log10(value)))];
  for (const auto& [exponent, samples] : decades)
    s.count("samples_with_h_1e" + std::to_string(exponent), samples);
}

/// How many samples keep all curves, and what fewer do to them.
void add_feature_bound(Summary& s, const fpo::RemeshResult& result) {
  if (result.collapsed_curves > 0) s.count("collapsed_curves", result.collapsed_curves);
  if (result.feature_bound.samples > 0) s.count("samples_for_features", result.feature_bound.samples);
  const std::string line = feature_bound_line(result);
  if (!line.empty()) s.line(line);
}

/// What was decided by default.
void add_features(Summary& s, const RemeshArguments& a, const fpo::RemeshResult& result) {
  if (!a.remesh.features || !a.remesh.features->yielding) return;
  if (!result.given_up.empty()) {
    s.text("features_given_up", result.given_up);
    if (!result.features_missed) s.line(result.given_up);  // else it is a warning
  }
  if (result.crease_curves == 0) return;
  s.count("crease_curves", result.crease_curves);
  s.count("crease_edges", result.crease_edges);
  s.line(worded("creases kept: %zu curves, %zu edges; --features none to round them off",
                result.crease_curves, result.crease_edges));
}

/// Where lengths that were to be even are not.
void add_uneven_lengths(Summary& s, const fpo::RemeshResult& result) {
  const auto [least, most] = std::ranges::minmax(result.wanted);
  if (!(least < uneven * most)) return;
  s.number("wanted_length_ratio", least / most, 4);
  s.line(worded(
      "lengths   down to %.2f of the others on blends, beside close curves and on thin parts; delta is "
      "in even spacings",
      least / most));
}

void add_rest(Summary& s, const RemeshArguments& a, const fpo::RemeshResult& result) {
  if (result.radius_factor > 0) s.number("disk_radius_over_h", result.radius_factor, 6);
  for (const fpo::Reached& r : result.reached) s.number(r.name, r.value, -1);
  if (a.remesh.sizing != fpo::SizingKind::uniform)
    add_sizing(s, result);
  else if (!result.wanted.empty())
    add_uneven_lengths(s, result);
  if (result.least_length > 0) {
    s.number("least_length", result.least_length, 1);
    s.line(worded("lengths   none below %.1f even spacings: there are too few samples for those asked for",
                  result.least_length));
  }
  if (result.coarse_facets > 0) {
    s.count("coarse_facets", result.coarse_facets);
    s.line(worded("coarser   %s on a surface of %zu facets (--no-coarse-start)",
                  result.made_coarser ? "the remesh was made" : "all iterations but the last",
                  result.coarse_facets));
  }
  if (result.thin_parts.places > 0) {
    s.count("thin_places", result.thin_parts.places);
    s.number("edges_elsewhere_longer_by", result.thin_parts.scale, 4);
  }
  if (result.brought > 0) s.count("samples_moved_to_mend", result.brought);
  if (result.by_collapses) {
    s.count("by_collapses", 1);
    s.line("mesh      what is left of the surface when all else has collapsed: the diagram was at fault");
  }
  if (result.feature_samples > 0) {
    s.count("feature_samples", result.feature_samples);
    s.count("feature_edges", result.feature_edges);
    if (!result.has_levels) s.count("proven_feature_edges", result.proven_edges);
    s.count("broken_feature_edges", result.broken_feature_edges);
    s.count("protected_samples", result.protection.weighted);
    if (result.finish.recovered_edges > 0) s.count("recovered_feature_edges", result.finish.recovered_edges);
  }
  if (a.remesh.improve_fidelity) {
    s.count("far_triangles_tried", result.fidelity.tried);
    s.count("far_triangles_mended", result.fidelity.mended);
  }
  if (a.remesh.closer == fpo::Closer::always || result.closeness.tried > 0) {
    s.count("closer_tried", result.closeness.tried);
    s.count("closer_mended", result.closeness.mended);
  }
  if (a.remesh.maximal) {
    s.count("maximal", result.maximal.maximal ? 1 : 0);
    s.count("maximal_moves", result.maximal.moves);
  }
  if (a.remesh.optimize_angles) {
    s.count("bad_triangles_before", result.angles.bad_before);
    s.count("bad_triangles_after", result.angles.bad_after);
    s.count("angles_tried", result.angles.tried);
    s.count("angles_mended", result.angles.mended);
    s.count("samples_reweighted", result.angles.reweighted);
    const fpo::Finish& finish = result.finish;
    if (const std::size_t mended = finish.last_angles.mended + finish.mended_with_delta; mended > 0)
      s.count("last_angles_mended", mended);
  }
}

void add_words(Summary& s, const RemeshArguments& a, const geom::TriMesh& input,
               const fpo::RemeshResult& result, const RemeshRun& run) {
  const std::string out = (a.output.empty() ? a.points : a.output).string();
  s.line(worded("%s: %zu vertices, %zu triangles, of %s with %zu", out.c_str(), result.mesh.num_vertices(),
                result.mesh.num_facets(), a.input.c_str(), input.num_facets()));
  const fpo::OptimizeResult& o = result.optimization;
  s.line(
      worded("time      %.1f s; %d iterations, %s", run.seconds, o.last.iteration, name_of(o.reason, run)));
}

}  // namespace

Summary summary_of(const RemeshArguments& a, const geom::TriMesh& input, const fpo::AtLeastResult& found,
                   const RemeshRun& run, const std::optional<fpo::SurfaceDistance>& distance) {
  const fpo::RemeshResult& result = found.remesh;
  Summary s;
  const Shape shape = shape_of(input, result.mesh);
  const Spacing spacing = spacing_of(a, result, shape);
  add_run(s, a, result, run, spacing);
  if (found.runs > 1) {
    s.count("not_enough_samples", found.not_enough);
    s.count("runs", found.runs);
  }
  add_rest(s, a, result);
  add_words(s, a, input, result, run);
  s.line(worded("spacing   smallest %.3f, mean %.3f of the %s", spacing.delta, spacing.mean_delta,
                spacing.uniform ? "hexagonal one" : "wanted length"));
  add_features(s, a, result);
  add_feature_bound(s, result);
  if (result.mesh.num_facets() == 0) return s;
  const fpo::Quality& q = shape.quality;
  s.number("edge_mean", shape.mean_edge, -1);
  s.number("Qmin", q.q_min, 6);
  s.number("Qavg", q.q_avg, 6);
  s.number("edge_min_of_wanted", result.measures.least_edge, 4);
  s.number("theta_min", q.theta_min, 4);
  s.number("theta_min_avg", q.theta_min_avg, 4);
  s.number("theta_max", q.theta_max, 4);
  s.line(worded("edges     %.4g long on average", shape.mean_edge));
  s.line(worded("angles    %.1f to %.1f degrees, the smallest of a triangle %.1f on average", q.theta_min,
                q.theta_max, q.theta_min_avg));
  s.line(worded("shape Q   %.3f at worst, %.3f on average (1: equilateral)", q.q_min, q.q_avg));
  if (distance) {
    s.number("dH_pct", distance->max, 6);
    s.number("dRMS_pct", distance->rms, 6);
    s.line(worded("distance  %.4g at most (%.3g %% of the diagonal), %.4g on average",
                  distance->max / 100 * input.diagonal(), distance->max,
                  distance->rms / 100 * input.diagonal()));
  }
  return s;
}

}  // namespace tools
