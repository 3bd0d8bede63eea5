#include "fpo/features/weak_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "fpo/features/feature_choice.h"
#include "geom/mesh/angles.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr double crowd = 0.25;  // in spacings
constexpr double full_fold = std::numbers::pi / 2;

/// Between the planes of the two facets at edge (a, b), one of which is t; facets run against each other.
double fold_at(const TriMesh& mesh, FacetId t, VertexId a, VertexId b) {
  const TriMesh::Facet& f = mesh.facet(t);
  for (std::size_t e = 0; e < 3; ++e) {
    if (std::minmax(f[e], f[(e + 1) % 3]) != std::minmax(a, b)) continue;
    const FacetId other = mesh.across(t, static_cast<int>(e));
    if (!other.valid()) return 0;
    return geom::angle_between(mesh.normal(t), mesh.normal(other));
  }
  return 0;
}

std::vector<double> lengths_of(const TriMesh& mesh, const Features& features) {
  std::vector<double> lengths;
  for (const FeatureCurve& curve : features.curves) lengths.push_back(length_of(mesh, curve));
  return lengths;
}

/// Folds times lengths.
std::vector<double> folds_of_edges(const TriMesh& mesh, const FeatureCurve& curve) {
  std::vector<double> folds;
  for (std::size_t i = 0; i < curve.facets.size(); ++i) {
    const VertexId a = curve.vertices[i], b = curve.vertices[(i + 1) % curve.vertices.size()];
    folds.push_back(std::min(fold_at(mesh, curve.facets[i], a, b), full_fold) *
                    (mesh.position(b) - mesh.position(a)).norm());
  }
  return folds;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Its mean, by length.
double fold_of(const TriMesh& mesh, const FeatureCurve& curve, double length) {
  return length > 0 ? sum_of(folds_of_edges(mesh, curve)) / length : 0;
}

}  // namespace

SeenCurves seen_curves(const TriMesh& mesh, const Features& features, double spacing) {
  const std::vector<double> lengths = lengths_of(mesh, features);
  SeenCurves result{lengths, lengths, narrow_places(mesh, features, spacing), spacing};
  std::vector<double>& seen = result.strengths;
  for (const NarrowPlace& place : result.places)
    if (place.nearest) seen[place.curve] -= place.length * (1 - place.width / (narrow_width * spacing));
  for (std::size_t c = 0; c < seen.size(); ++c)
    seen[c] = features.curves[c].sheets == 2 ? std::max(seen[c], 0.0) / spacing *
                                                   fold_of(mesh, features.curves[c], lengths[c]) / full_fold
                                             : std::numeric_limits<double>::infinity();
  return result;
}

std::vector<double> seen_of_edges(const TriMesh& mesh, const FeatureCurve& curve) {
  std::vector<double> edges = folds_of_edges(mesh, curve);
  const double sum = sum_of(edges);
  for (double& edge : edges) edge = sum > 0 ? edge / sum : 1 / static_cast<double>(edges.size());
  return edges;
}

double total_strength(const SeenCurves& curves) {
  double sum = 0;
  for (const double strength : curves.strengths)
    if (std::isfinite(strength)) sum += strength;
  return sum;
}

std::vector<std::size_t> weakest_curves(const SeenCurves& curves, const WeakCurves& wanted) {
  const std::vector<double>& strengths = curves.strengths;
  std::vector<double> crowded(strengths.size(), 0.0);
  std::set<std::pair<std::size_t, std::size_t>> facing;
  for (const NarrowPlace& place : curves.places) {
    facing.insert(std::minmax(place.curve, place.other));
    if (place.nearest && place.width < crowd * curves.spacing) crowded[place.curve] += place.length;
  }
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < strengths.size(); ++c)
    if (std::isfinite(strengths[c]) && (!wanted.only_crowded || crowded[c] > curves.lengths[c] / 2))
      order.push_back(c);
  const double enough = std::max(1.0, wanted.share * static_cast<double>(order.size()));
  std::ranges::stable_sort(order, {}, [&](std::size_t c) {
    return std::pair(curves.lengths[c] < shortest_curve * curves.spacing, strengths[c]);
  });
  std::vector<std::size_t> weakest;
  for (const std::size_t c : order) {
    if (static_cast<double>(weakest.size()) + 1 > enough) break;
    const auto faces = [&](std::size_t other) { return facing.contains(std::minmax(c, other)); };
    if (std::ranges::none_of(weakest, faces)) weakest.push_back(c);
  }
  std::ranges::sort(weakest);
  return weakest;
}

std::vector<std::array<VertexId, 2>> edges_of_curves(const Features& features,
                                                     std::span<const std::size_t> curves) {
  std::vector<std::array<VertexId, 2>> edges;
  for (const std::size_t c : curves) {
    const FeatureCurve& curve = features.curves[c];
    for (std::size_t i = 0; i < curve.facets.size(); ++i)
      edges.push_back({curve.vertices[i], curve.vertices[(i + 1) % curve.vertices.size()]});
  }
  return edges;
}

}  // namespace fpo
