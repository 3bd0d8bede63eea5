#include "fpo/remesh/lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "fpo/baselines/disks.h"
#include "fpo/surface/curvature.h"
#include "geom/check.h"
#include "geom/mesh/angles.h"
#include "geom/mesh/centring.h"
#include "geom/mesh/opened_mesh.h"
#include "geom/mesh/scaling.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

using MeshEdge = std::array<VertexId, 2>;

std::set<MeshEdge> edges_of(const Features& features) {
  std::set<MeshEdge> edges;
  for (const FeatureCurve& curve : features.curves)
    for (std::size_t i = 0; i < curve.facets.size(); ++i) {
      const VertexId a = curve.vertices[i], b = curve.vertices[(i + 1) % curve.vertices.size()];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  return edges;
}

/// Corner i of facet t is 3 t + i. Corners at a vertex are one where their facets share an edge of no curve.
geom::DisjointSets joined_corners(const TriMesh& mesh, const std::set<MeshEdge>& features) {
  struct Side {
    MeshEdge edge;
    std::array<std::size_t, 2> corners;  ///< at its ends
  };
  std::vector<Side> sides;
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t e = 0; e < 3; ++e) {
      Side side{{mesh.facet(t)[e], mesh.facet(t)[(e + 1) % 3]},
                {3 * t.index() + e, 3 * t.index() + (e + 1) % 3}};
      if (side.edge[1] < side.edge[0]) {
        std::swap(side.edge[0], side.edge[1]);
        std::swap(side.corners[0], side.corners[1]);
      }
      if (!features.contains(side.edge)) sides.push_back(side);
    }
  std::ranges::stable_sort(sides, {}, &Side::edge);
  geom::DisjointSets sets(3 * mesh.num_facets());
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
    if (sides[i].edge == sides[i + 1].edge)
      for (std::size_t end : {0u, 1u}) sets.merge(sides[i].corners[end], sides[i + 1].corners[end]);
  return sets;
}

/// Opened along features: sides of a curve have vertices of their own.
geom::OpenedMesh opened(const TriMesh& mesh, const Features& features) {
  geom::DisjointSets corners = joined_corners(mesh, edges_of(features));
  return geom::opened(mesh, corners);
}

Features features_of(const TriMesh& surface, const RemeshOptions& options, double spacing) {
  if (!options.features) return {};
  FeatureOptions wanted = *options.features;
  wanted.turn_scale = spacing / 2;
  return find_features(surface, wanted);
}

std::size_t checked(double count) {
  geom::require(count <= static_cast<double>(most_samples_by_length),
                "these lengths take more than 20 million samples: are they in the units of the surface?");
  return static_cast<std::size_t>(std::max(1.0, std::round(count)));
}

void require_length(const std::optional<double>& length, const std::string& name) {
  geom::require(!length || (*length > 0 && std::isfinite(*length)), name + " must be positive and finite");
}

/// Wanted lengths at the vertices, by error or by what is given, at most `longest`.
VertexField absolute_lengths(const TriMesh& surface, const Lengths& lengths, const RemeshOptions& options,
                             double longest) {
  if (!lengths.error) {
    VertexField h = options.rho;
    for (double& value : h) value = std::min(value, longest);
    return h;
  }
  const double largest = std::min(longest, surface.diagonal() / 10);
  return error_size(surface, features_of(surface, options, largest), *lengths.error, largest);
}

/// Of a surface of about unit size; all lengths are its own.
void set_number_there(const TriMesh& surface, const Lengths& lengths, RemeshOptions& options) {
  geom::require(surface.area() > 0, "the surface has no area");
  const double longest = lengths.edge_length ? *lengths.edge_length / mean_edge_over_wanted
                                             : std::numeric_limits<double>::infinity();
  Sizing sizing = Sizing::uniform(1);
  if (lengths.error || options.sizing == SizingKind::given) {
    VertexField h = absolute_lengths(surface, lengths, options, longest);
    sizing = graded_sizing(surface, std::move(h), options.limits.gradation);
    options.sizing = SizingKind::given;
    options.rho.clear();
    for (std::size_t v = 0; v < surface.num_vertices(); ++v)
      options.rho.push_back(sizing.at(geom::VertexId(v)));
  } else {
    sizing = Sizing::uniform(longest);
  }
  const double area_h2 = 2 / std::sqrt(3.0) * surface.area();
  const double inner = sizing.is_uniform()
                           ? area_h2 / (longest * longest)
                           : num_samples(surface, sizing, 2 * static_cast<double>(most_samples_by_length));
  const std::size_t count = checked(inner);
  const Features features = features_of(surface, options, hexagonal_spacing(surface.area(), count));
  const std::vector<SurfaceSample> fixed = points_on_surface(surface, options.fixed);
  const FeatureSamples samples =
      sample_features(surface, features, fixed, sizing, {2 * most_samples_by_length, options.seed});
  options.num_samples =
      std::max(checked(inner + samples.missing_shares), least_number_of_samples(surface, features, fixed));
}

}  // namespace

namespace {

constexpr double h2_by_error_and_radius = 3.5;

/// The distance of a facet's third corner from its edge e.
double height(const TriMesh& mesh, FacetId t, int e) {
  const double length = (mesh.corner(t, (e + 1) % 3) - mesh.corner(t, e)).norm();
  return length > 0 ? mesh.normal(t).norm() / length : 0;
}

/// Where facets are about as wide as wanted edges, the folds between them are what bends: a fold over the
/// width of its facets is a curvature. Where they are finer folds may be noise, and the fit knows better.
void heed_folds(const TriMesh& mesh, double error, VertexField& h) {
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const FacetId other = mesh.across(t, e);
      if (!other.valid() || other < t) continue;
      int back = 0;
      while (back < 2 && mesh.across(other, back) != t) ++back;
      const double fold = geom::angle_between(mesh.normal(t), mesh.normal(other));
      const double width = (height(mesh, t, e) + height(mesh, other, back)) / 2;
      if (!(fold > 0) || !(width > 0)) continue;
      const double length = std::max(std::sqrt(h2_by_error_and_radius * error * width / fold), error);
      if (2 * width < length) continue;
      for (const FacetId f : {t, other})
        for (const VertexId x : mesh.facet(f)) h[x] = std::min(h[x], length);
    }
}

}  // namespace

VertexField error_size(const TriMesh& surface, const Features& features, double error, double largest) {
  const geom::OpenedMesh open = opened(surface, features);
  const VertexField radius = curvature_size(open.mesh, {});
  VertexField there;
  for (const double r : radius)
    there.push_back(
        std::clamp(std::sqrt(h2_by_error_and_radius * error * r), std::min(error, largest), largest));
  heed_folds(open.mesh, error, there);
  VertexField h(surface.num_vertices(), largest);
  for (VertexId v(0); v.index() < open.origin.size(); v = VertexId(v.value + 1))
    h[open.origin[v]] = std::min(h[open.origin[v]], there[v]);
  return h;
}

void set_number_of_samples(const TriMesh& surface, const Lengths& given, RemeshOptions& options) {
  Lengths lengths = given;
  require_length(lengths.radius, "the radius");
  if (lengths.radius) {
    lengths.edge_length = mean_edge_over_wanted * *lengths.radius / usual_radius_factor;
    options.disk_radius = *lengths.radius;
  }
  require_length(lengths.edge_length, "the edge length");
  require_length(lengths.error, "the error");
  geom::require(lengths.edge_length || lengths.error || options.sizing == SizingKind::given,
                "a number of samples, an edge length, an error or a sizing in lengths is needed");
  geom::require(!lengths.error || options.sizing == SizingKind::uniform,
                "an error has its own sizing: no other goes with it");
  const geom::Vec3 middle = geom::far_middle(surface);
  const TriMesh near = middle.isZero(0) ? surface : geom::moved_by(surface, -middle);
  const double factor = geom::factor_to_unit_box(near);
  RemeshOptions there = options;
  for (geom::Vec3& point : there.fixed) point = factor * (point - middle);
  for (double& length : there.rho) length *= factor;
  Lengths scaled = lengths;
  if (scaled.edge_length) *scaled.edge_length *= factor;
  if (scaled.error) *scaled.error *= factor;
  set_number_there(geom::scaled_to_unit_box(near, factor), scaled, there);
  options.num_samples = there.num_samples;
  options.sizing = there.sizing;
  options.rho = there.rho;  // pipeline.h takes them up to a factor
}

}  // namespace fpo
