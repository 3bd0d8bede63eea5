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

constexpr std::size_t much_longer = 16;  // than the list a table is not

/// The places of elements in an ascending list: by a table, if ids are dense enough.
template <class I>
class Places {
 public:
  /// Keeps a reference.
  explicit Places(const std::vector<I>& ascending) : ascending_(ascending) {
    if (ascending.empty()) return;
    first_ = ascending.front().index();
    const std::size_t range = ascending.back().index() + 1 - first_;
    if (range > much_longer * ascending.size()) return;
    table_.resize(range);
    for (std::size_t i = 0; i < ascending.size(); ++i) table_[ascending[i].index() - first_] = I(i);
  }
  /// None of one that is not in the list, or none.
  I of(I element) const {
    if (table_.empty()) return place_of(ascending_, element);
    const std::size_t i = element.index() - first_;
    return element.valid() && i < table_.size() ? table_[i] : I();
  }

 private:
  const std::vector<I>& ascending_;
  std::size_t first_ = 0;
  std::vector<I> table_;
};

/// The corners of the facets, ascending.
std::vector<VertexId> corners_of(const TriMesh& whole, const std::vector<FacetId>& facets) {
  std::vector<VertexId> all;
  if (whole.num_vertices() <= much_longer * facets.size()) {
    std::vector<char> is_one(whole.num_vertices(), 0);
    for (const FacetId t : facets)
      for (const VertexId v : whole.facet(t)) is_one[v.index()] = 1;
    for (std::size_t v = 0; v < is_one.size(); ++v)
      if (is_one[v]) all.emplace_back(v);
    return all;
  }
  for (const FacetId t : facets) all.insert(all.end(), whole.facet(t).begin(), whole.facet(t).end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

FacetId Submesh::here(FacetId of_whole) const { return place_of(facets, of_whole); }

Submesh submesh(const TriMesh& whole, std::vector<FacetId> facets) {
  Submesh part;
  part.facets = std::move(facets);
  part.vertices = corners_of(whole, part.facets);
  const Places vertices(part.vertices);
  const Places places(part.facets);
  Table<VertexId, Vec3> positions;
  for (const VertexId v : part.vertices) positions.push_back(whole.position(v));
  Table<FacetId, TriMesh::Facet> renamed;
  TriMesh::Across across;
  for (const FacetId t : part.facets) {
    TriMesh::Facet& corners = renamed.emplace_back();
    std::array<FacetId, 3>& beyond = across.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = vertices.of(whole.facet(t)[i]);
      beyond[i] = places.of(whole.across(t, static_cast<int>(i)));
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
