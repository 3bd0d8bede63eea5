#include "geom/mesh/submesh.h"

#include <algorithm>

namespace geom {
namespace {

/// The place of an element in an ascending list, or none.
template <class I>
I place_of(const std::vector<I>& ascending, I element) {
  const auto at = std::ranges::lower_bound(ascending, element);
  return at != ascending.end() && *at == element ? I(static_cast<std::size_t>(at - ascending.begin())) : I();
}

}  // namespace

FacetId Submesh::here(FacetId of_whole) const { return place_of(facets, of_whole); }

Submesh submesh(const TriMesh& whole, std::vector<FacetId> facets) {
  Submesh part;
  part.facets = std::move(facets);
  for (const FacetId t : part.facets)
    part.vertices.insert(part.vertices.end(), whole.facet(t).begin(), whole.facet(t).end());
  std::ranges::sort(part.vertices);
  part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()), part.vertices.end());

  Table<VertexId, Vec3> positions;
  for (const VertexId v : part.vertices) positions.push_back(whole.position(v));
  Table<FacetId, TriMesh::Facet> renamed;
  TriMesh::Across across;
  for (const FacetId t : part.facets) {
    TriMesh::Facet& corners = renamed.emplace_back();
    std::array<FacetId, 3>& beyond = across.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = place_of(part.vertices, whole.facet(t)[i]);
      beyond[i] = part.here(whole.across(t, static_cast<int>(i)));
    }
  }
  part.mesh = TriMesh(std::move(positions), std::move(renamed), std::move(across), whole.box());
  if (!whole.has_levels()) return part;
  Table<VertexId, double> levels;
  for (const VertexId v : part.vertices) levels.push_back(whole.level(v));
  part.mesh = part.mesh.with_levels(std::move(levels));
  return part;
}

}  // namespace geom
