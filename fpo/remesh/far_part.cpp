#include "fpo/remesh/far_part.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "geom/mesh/aabb_tree.h"

namespace fpo {

using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr std::int32_t nobody = -1;

/// For each facet a sample that is near it and has a triangle: the facets that hold one, then those next to
/// them, and so on.
std::vector<std::int32_t> nearby_samples(const TriMesh& surface, const TriMesh& remesh,
                                         std::span<const SurfaceSample> samples) {
  std::vector<char> is_used(samples.size(), 0);
  for (const TriMesh::Facet& f : remesh.facets())
    for (const VertexId v : f) is_used[v.index()] = 1;
  std::vector<std::int32_t> near(surface.num_facets(), nobody);
  std::vector<FacetId> reached;
  reached.reserve(surface.num_facets());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::int32_t& sample = near[samples[i].facet.index()];
    if (sample != nobody || !is_used[i]) continue;
    sample = static_cast<std::int32_t>(i);
    reached.push_back(samples[i].facet);
  }
  for (std::size_t k = 0; k < reached.size(); ++k)
    for (int e = 0; e < 3; ++e) {
      const FacetId next = surface.across(reached[k], e);
      if (!next.valid() || near[next.index()] != nobody) continue;
      near[next.index()] = near[reached[k].index()];
      reached.push_back(next);
    }
  return near;
}

/// Vertices that are farther from a nearby sample than the length wanted at them; parts without samples are
/// no matter here.
std::vector<VertexId> vertices_in_question(const TriMesh& surface, const VertexField& wanted,
                                           const TriMesh& remesh, std::span<const SurfaceSample> samples) {
  const std::vector<std::int32_t> near = nearby_samples(surface, remesh, samples);
  std::vector<char> is_near(surface.num_vertices(), 0);
  std::vector<VertexId> result;
  const auto for_corners = [&](auto visit) {
    for (FacetId t(0); t.index() < surface.num_facets(); t = FacetId(t.value + 1))
      if (near[t.index()] != nobody)
        for (const VertexId v : surface.facet(t))
          visit(v, samples[static_cast<std::size_t>(near[t.index()])]);
  };
  for_corners([&](VertexId v, const SurfaceSample& sample) {
    const double h = wanted[v];
    is_near[v.index()] |= (surface.position(v) - sample.position).squaredNorm() <= h * h;
  });
  for_corners([&](VertexId v, const SurfaceSample&) {
    if (is_near[v.index()]) return;
    is_near[v.index()] = 1;  // once is enough
    result.push_back(v);
  });
  return result;
}

}  // namespace

FarPart far_part(const TriMesh& surface, const VertexField& wanted, const TriMesh& remesh,
                 std::span<const SurfaceSample> samples) {
  FarPart farthest;
  if (remesh.num_facets() == 0) return farthest;
  const std::vector<VertexId> vertices = vertices_in_question(surface, wanted, remesh, samples);
  if (vertices.empty()) return farthest;
  const geom::AabbTree tree(remesh);
  FacetId hint;
  for (const VertexId v : vertices) {
    const auto closest = tree.closest(surface.position(v), hint);
    hint = closest.facet;
    const double distance = std::sqrt(closest.distance2), of_wanted = distance / wanted[v];
    if (of_wanted > 1 && of_wanted > farthest.of_wanted)
      farthest = {of_wanted, distance, surface.position(v)};
  }
  return farthest;
}

}  // namespace fpo
