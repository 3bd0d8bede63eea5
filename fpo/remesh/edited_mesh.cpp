#include "fpo/remesh/edited_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geom/check.h"

namespace fpo {

using geom::TriMesh;
using geom::Vec3;

EditedMesh::EditedMesh(const TriMesh& mesh)
    : positions_(mesh.vertices()), facets_(mesh.facets()), at_(mesh.num_vertices()) {
  for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1))
    for (const VertexId v : facets_[t]) at_[v].push_back(t);
}

Vec3 EditedMesh::normal(FacetId t) const {
  const auto& [a, b, c] = facets_[t];
  return (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]);
}

bool EditedMesh::has_edge(VertexId a, VertexId b) const {
  return std::ranges::any_of(at_[a],
                             [&](FacetId t) { return std::ranges::find(facets_[t], b) != facets_[t].end(); });
}

EditedMesh::FacetId EditedMesh::beside(VertexId a, VertexId b) const {
  FacetId found;
  for (const FacetId t : at_[a])
    for (std::size_t i = 0; i < 3; ++i)
      if (facets_[t][i] == a && facets_[t][(i + 1) % 3] == b) {
        if (found.valid()) return FacetId();
        found = t;
      }
  return found;
}

EditedMesh::VertexId EditedMesh::third(FacetId t, VertexId a, VertexId b) const {
  return *std::ranges::find_if(facets_[t], [&](VertexId v) { return v != a && v != b; });
}

bool EditedMesh::is_on_border(VertexId v) const {
  return std::ranges::any_of(at_[v], [&](FacetId t) {
    return std::ranges::any_of(
        facets_[t], [&](VertexId w) { return w != v && (!beside(v, w).valid() || !beside(w, v).valid()); });
  });
}

bool EditedMesh::can_flip(VertexId a, VertexId b) const {
  const FacetId t = beside(a, b), u = beside(b, a);
  if (!t.valid() || !u.valid()) return false;
  const VertexId c = third(t, a, b), d = third(u, a, b);
  return c != d && !has_edge(c, d);
}

// The facets a, b, c and b, a, d become a, d, c and d, b, c.
void EditedMesh::flip(VertexId a, VertexId b) {
  const FacetId t = beside(a, b), u = beside(b, a);
  geom::ensure(t.valid() && u.valid(), "an edge without two facets is flipped");
  const VertexId c = third(t, a, b), d = third(u, a, b);
  edits_.push_back({t, facets_[t], a, positions_[a]});
  set(t, {a, d, c});
  edits_.push_back({u, facets_[u], a, positions_[a]});
  set(u, {d, b, c});
}

void EditedMesh::set(FacetId t, const Facet& facet) {
  for (const VertexId v : facets_[t]) std::erase(at_[v], t);
  facets_[t] = facet;
  for (const VertexId v : facet) at_[v].insert(std::ranges::lower_bound(at_[v], t), t);
}

void EditedMesh::move(VertexId v, const Vec3& to) {
  edits_.push_back({{}, {}, v, positions_[v]});
  positions_[v] = to;
}

void EditedMesh::undo_to(std::size_t num_edits) {
  for (; edits_.size() > num_edits; edits_.pop_back()) {
    const Edit& last = edits_.back();
    if (last.t.valid())
      set(last.t, last.facet);
    else
      positions_[last.v] = last.at;
  }
}

TriMesh EditedMesh::mesh() const {
  geom::Table<FacetId, Facet> facets = facets_;
  for (Facet& f : facets) std::rotate(f.begin(), std::ranges::min_element(f), f.end());
  std::ranges::sort(facets);
  return TriMesh(positions_, std::move(facets));
}

}  // namespace fpo
