#include "fpo/remesh/noise.h"

#include <algorithm>
#include <utility>

#include "fpo/remesh/stand_in.h"
#include "fpo/remesh/stand_in_remesh.h"
#include "fpo/surface/barycentric.h"
#include "geom/mesh/scaling.h"

namespace fpo {

using geom::FacetId;
using geom::Table;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr std::size_t facets_a_cell = 6;  // at least, in noise
constexpr double cosine_of_fold = 0.866;
constexpr std::size_t facets_a_pass = 5, least_passes = 4, most_smoothing = 200;  // of a cell

/// Visits each side of each facet with its ends, and whether it is at a border.
template <class Visit>
void for_each_side(const TriMesh& mesh, Visit visit) {
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t e = 0; e < 3; ++e)
      visit(mesh.facet(t)[e], mesh.facet(t)[(e + 1) % 3], !mesh.across(t, static_cast<int>(e)).valid());
}

std::vector<SurfaceSample> brought(const std::vector<SurfaceSample>& from, std::size_t num_fixed,
                                   const TriMesh& smooth, const TriMesh& surface) {
  std::vector<SurfaceSample> samples = brought_to(surface, from);
  const std::vector<Vec3> weights = barycentric_coordinates(smooth, from);
  for (std::size_t i = 0; i < num_fixed; ++i) {
    const FacetId t = from[i].facet;
    Vec3 x(0, 0, 0);
    for (int k = 0; k < 3; ++k) x += weights[i][k] * surface.corner(t, k);
    samples[i] = {geom::snapped(x), t};
  }
  return samples;
}

}  // namespace

bool is_folded(const TriMesh& surface) {
  std::size_t edges = 0, folded = 0;
  for (FacetId t(0); t.index() < surface.num_facets(); t = FacetId(t.value + 1))
    for (int e = 0; e < 3; ++e) {
      const FacetId u = surface.across(t, e);
      if (!u.valid() || u < t) continue;
      const Vec3 a = surface.normal(t), b = surface.normal(u);
      ++edges;
      folded += a.dot(b) < cosine_of_fold * a.norm() * b.norm();
    }
  return edges > 0 && 2 * folded > edges;
}

bool has_noise(const TriMesh& surface, std::size_t n) {
  return surface.num_facets() / facets_a_cell >= n && is_folded(surface);
}

bool may_be_smoothed(const RemeshOptions& options) {
  const bool has_marks = options.features && !options.features->marked.empty();
  return options.method == Method::fpo && options.optimize.max_iterations > 0 && options.fixed.empty() &&
         !options.maximal && !has_marks;
}

TriMesh smoothed(const TriMesh& surface, std::size_t n) {
  Table<VertexId, Vec3> positions = surface.vertices();
  Table<VertexId, char> on_border(positions.size(), 0);
  for_each_side(surface, [&](VertexId a, VertexId b, bool border) {
    if (border) on_border[a] = on_border[b] = 1;
  });
  const std::size_t wanted = surface.num_facets() / std::max<std::size_t>(n, 1) / facets_a_pass;
  for (std::size_t pass = 0; pass < std::clamp(wanted, least_passes, most_smoothing); ++pass) {
    Table<VertexId, Vec3> sums(positions.size(), Vec3(0, 0, 0));
    Table<VertexId, double> counts(positions.size(), 0.0);
    for_each_side(surface, [&](VertexId a, VertexId b, bool border) {
      if (border || !on_border[a]) sums[a] += positions[b], counts[a] += 1;
      if (border || !on_border[b]) sums[b] += positions[a], counts[b] += 1;
    });
    for (VertexId v(0); v.index() < positions.size(); v = VertexId(v.value + 1))
      if (counts[v] > 0) positions[v] = 0.5 * positions[v] + 0.5 * sums[v] / counts[v];
  }
  for (Vec3& p : positions) p = geom::snapped(p);
  return surface.with_vertices(std::move(positions));
}

RemeshResult on_noise(RemeshResult remesh, const TriMesh& smooth, const TriMesh& surface,
                      const RemeshOptions& options) {
  remesh.stood_in = true;
  remesh.samples = brought(remesh.samples, remesh.feature_samples, smooth, surface);
  return with_mesh_on(surface, std::move(remesh), options);
}

}  // namespace fpo
