#include "tools/report_charts.h"

#include <algorithm>
#include <cmath>

#include "fpo/measure/triangle_angles.h"

namespace tools {
namespace {

using geom::TriMesh;
using geom::VertexId;

constexpr const char* first_colour = "#1d4f91";
constexpr const char* second_colour = "#c0392b";

/// Shares in percent over [0, width * counts.size()].
io::Series bars(const std::vector<double>& counts, double width) {
  double sum = 0;
  for (const double c : counts) sum += c;
  io::Series series;
  series.style = io::Series::Style::bars;
  series.colour = first_colour;
  for (std::size_t i = 0; i < counts.size(); ++i)
    series.points.push_back({width * static_cast<double>(i), sum > 0 ? 100 * counts[i] / sum : 0});
  series.points.push_back({width * static_cast<double>(counts.size()), 0});
  return series;
}

void count(std::vector<double>& counts, double value, double width) {
  const auto bin = static_cast<std::size_t>(std::max(value, 0.0) / width);
  counts[std::min(bin, counts.size() - 1)] += 1;
}

}  // namespace

io::Chart angle_histogram(const TriMesh& mesh) {
  constexpr double width = 2;
  std::vector<double> counts(90);
  for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1))
    for (const double angle : fpo::angles_of(mesh, t)) count(counts, angle, width);
  io::Chart chart{"Angles", {"degrees", 0, 180}, {"% of angles"}, {}, {}};
  chart.series.push_back(bars(counts, width));
  return chart;
}

io::Chart length_histogram(const TriMesh& mesh, const fpo::VertexField& wanted) {
  constexpr double width = 0.02;
  std::vector<double> counts(125);
  for (geom::FacetId t(0); t.index() < mesh.num_facets(); t = geom::FacetId(t.value + 1)) {
    for (int e = 0; e < 3; ++e) {
      const geom::FacetId other = mesh.across(t, e);
      if (other.valid() && other < t) continue;  // each edge once
      const auto k = static_cast<std::size_t>(e);
      const VertexId a = mesh.facet(t)[k], b = mesh.facet(t)[(k + 1) % 3];
      count(counts, (mesh.position(a) - mesh.position(b)).norm() / std::sqrt(wanted[a] * wanted[b]), width);
    }
  }
  io::Chart chart{"Edge lengths", {"length / wanted length", 0, 2.5}, {"% of edges"}, {}, {}};
  chart.series.push_back(bars(counts, width));
  return chart;
}

io::Chart convergence_chart(std::span<const fpo::IterationReport> iterations) {
  io::Chart chart{"Convergence", {"iteration"}, {"in wanted edge lengths", 0.4, 1}, {}, {}};
  io::Series delta, mean;
  delta.colour = first_colour;
  mean.colour = second_colour;
  for (const fpo::IterationReport& r : iterations) {
    delta.points.push_back({static_cast<double>(r.iteration), r.delta});
    mean.points.push_back({static_cast<double>(r.iteration), r.mean_delta});
  }
  chart.x.high = std::max(1.0, delta.points.empty() ? 1.0 : delta.points.back().x());
  chart.series = {delta, mean};
  return chart;
}

}  // namespace tools
