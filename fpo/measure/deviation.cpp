#include "fpo/measure/deviation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geom/mesh/aabb_tree.h"
#include "geom/parallel.h"

namespace fpo {

using geom::AabbTree;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr std::size_t batch = 128;  // facets a thread takes at a time

/// The largest distance of points of a facet.
double deviation_of(const TriMesh& mesh, FacetId t, const AabbTree& reference) {
  const std::array<Vec3, 3> q{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  const Vec3 middle = (q[0] + q[1] + q[2]) / 3;
  AabbTree::Closest closest = reference.closest(middle);
  double most2 = closest.distance2;
  const auto look = [&](const Vec3& x) {
    closest = reference.closest(x, closest.facet);
    most2 = std::max(most2, closest.distance2);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    look((q[k] + q[(k + 1) % 3]) / 2);
    look((q[k] + middle) / 2);
  }
  return std::sqrt(most2);
}

/// Of one facet of the reference: its corners, the middles of its edges, its own.
using Seen = std::array<std::pair<FacetId, double>, 7>;

Seen seen_from(const TriMesh& reference, FacetId t, const AabbTree& mesh) {
  const std::array<Vec3, 3> q{reference.corner(t, 0), reference.corner(t, 1), reference.corner(t, 2)};
  std::array<Vec3, 7> points;
  for (std::size_t k = 0; k < 3; ++k) points[k] = q[k], points[3 + k] = (q[k] + q[(k + 1) % 3]) / 2;
  points[6] = (q[0] + q[1] + q[2]) / 3;
  Seen seen;
  FacetId hint;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const AabbTree::Closest closest = mesh.closest(points[k], hint);
    hint = closest.facet;
    seen[k] = {closest.facet, std::sqrt(closest.distance2)};
  }
  return seen;
}

}  // namespace

geom::Table<FacetId, double> facet_deviations(const TriMesh& mesh, const TriMesh& reference, int threads) {
  const AabbTree tree(mesh), reference_tree(reference);
  geom::Table<FacetId, double> result(mesh.num_facets(), 0);
  geom::parallel_ranges(mesh.num_facets(), batch, threads, [&](std::size_t first, std::size_t last) {
    for (FacetId t(first); t.index() < last; t = FacetId(t.value + 1))
      result[t] = deviation_of(mesh, t, reference_tree);
  });
  std::vector<Seen> seen(reference.num_facets());
  geom::parallel_ranges(seen.size(), batch, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) seen[t] = seen_from(reference, FacetId(t), tree);
  });
  for (const Seen& of_facet : seen)
    for (const auto& [facet, distance] : of_facet) result[facet] = std::max(result[facet], distance);
  return result;
}

}  // namespace fpo
