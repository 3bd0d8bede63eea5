#include "fpo/remesh/final_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "fpo/measure/triangle_angles.h"
#include "geom/mesh/edges.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double rounding = 1e-9;                        // degrees
constexpr double thin_for_one_at_fault = 3;              // samples on thin parts
constexpr double in_a_ring = 3.5;                        // samples
constexpr double least_factor = 1.5, most_factor = 100;  // of the number of samples

void measure_edges(const TriMesh& mesh, const VertexField& wanted, std::size_t num_fixed,
                   FinalMeasures& result) {
  const std::vector<geom::MeshEdge> edges = geom::edges_of(mesh);
  std::vector<double> shortest(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  double sum = 0, least = std::numeric_limits<double>::infinity(), least_length = least;
  for (const auto& [a, b] : edges) {
    const double length = (mesh.position(a) - mesh.position(b)).norm();
    const double of_wanted = length / std::sqrt(wanted[a] * wanted[b]);
    const ShortEdge edge{length, (mesh.position(a) + mesh.position(b)) / 2,
                         a.index() < num_fixed && b.index() < num_fixed};
    sum += of_wanted;
    result.greatest_edge = std::max(result.greatest_edge, length / std::max(wanted[a], wanted[b]));
    if (of_wanted < least) least = of_wanted, result.least = edge;
    if (length < least_length) least_length = length, result.shortest = edge;
    for (const VertexId v : {a, b}) shortest[v.index()] = std::min(shortest[v.index()], length / wanted[v]);
  }
  result.mean_edge = sum / static_cast<double>(std::max<std::size_t>(edges.size(), 1));
  if (!edges.empty()) result.least_edge = least;
  if (num_fixed >= shortest.size()) num_fixed = 0;
  result.delta = std::numeric_limits<double>::infinity();
  double count = 0;
  sum = 0;
  for (std::size_t v = num_fixed; v < shortest.size(); ++v) {
    if (!std::isfinite(shortest[v])) continue;
    result.delta = std::min(result.delta, shortest[v]);
    sum += shortest[v], ++count;
  }
  if (count == 0) result.delta = 0;
  result.mean_delta = sum / std::max(count, 1.0);
}

void measure_angles(const TriMesh& mesh, const AngleOptions& bounds, FinalMeasures& result) {
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
    const std::array<double, 3> angles = angles_of(mesh, t);
    const auto [least, most] = std::ranges::minmax(angles);
    for (const double angle : angles) result.angles_below_30 += angle < 30 - rounding;
    result.theta_min = std::min(result.theta_min, least);
    result.bad_triangles += least < bounds.smallest || most > bounds.largest;
  }
}

}  // namespace

FinalMeasures final_measures(const TriMesh& mesh, const VertexField& wanted, std::size_t num_fixed,
                             const AngleOptions& angles) {
  FinalMeasures result;
  measure_edges(mesh, wanted, num_fixed, result);
  measure_angles(mesh, angles, result);
  return result;
}

namespace {

/// A fault, and how many times the samples would mend it.
struct FaultPlace {
  SurfaceSample at;
  double factor;
};

/// So many that a ring of them fits around. With even spacing that would be the square of this, but along a
/// horn or a handle lengths are lowered (thin_parts.h).
double factor_for(double girth, double h) {
  return girth > 0 ? std::clamp(h * in_a_ring / girth, least_factor, most_factor) : 2;
}

/// Where much of the surface is thin, samples cannot come from elsewhere: n grows with the square.
double factor_with_share(double factor, const Dual& dual) {
  std::vector<SiteId> at_fault;
  for (const CellFault& fault : dual.cell_faults) at_fault.push_back(fault.cell);
  for (const Defect& defect : dual.defects) at_fault.push_back(defect.at);
  std::ranges::sort(at_fault);
  at_fault.erase(std::unique(at_fault.begin(), at_fault.end()), at_fault.end());
  const double share = static_cast<double>(at_fault.size()) / static_cast<double>(dual.samples.size());
  const double thin = std::min(1.0, thin_for_one_at_fault * share);
  return std::max(factor, std::min(1 + thin * (factor * factor - 1), most_factor));
}

std::vector<FaultPlace> places_of(const Dual& dual, const TriMesh& surface, const geom::SurfaceType& type,
                                  const Sizing& sizing) {
  std::vector<FaultPlace> places;
  for (const CellFault& fault : dual.cell_faults) {
    const SurfaceSample& at = dual.samples[fault.cell.index()];
    places.push_back({at, factor_for(fault.other.valid() ? 0 : fault.girth, sizing.at(at))});
  }
  for (const Defect& defect : dual.defects)
    places.push_back({dual.samples[defect.at.index()], factor_for(0, 1)});
  for (const std::size_t part : dual.type.parts) {
    const auto first = std::ranges::find(type.part_of, part) - type.part_of.begin();
    const FacetId facet(static_cast<std::size_t>(first));
    if (places.empty() || dual.type.lost_parts > 0)
      places.push_back({{surface.corner(facet, 0), facet}, factor_for(0, 1)});
  }
  return places;
}

}  // namespace

TypeAdvice type_advice(const Dual& dual, const TriMesh& surface, const geom::SurfaceType& type,
                       const Sizing& sizing) {
  TypeAdvice advice;
  if (dual.type.ok()) return advice;
  double factor = least_factor;
  for (const FaultPlace& place : places_of(dual, surface, type, sizing)) {
    factor = std::max(factor, place.factor);
    const double near = 2 * sizing.at(place.at);
    const bool known = std::ranges::any_of(
        advice.places, [&](const Vec3& x) { return (x - place.at.position).norm() < near; });
    if (!known) advice.places.push_back(place.at.position);
  }
  factor = factor_with_share(factor, dual);
  advice.samples = static_cast<std::size_t>(factor * static_cast<double>(dual.samples.size()));
  return advice;
}

}  // namespace fpo
