#include "fpo/remesh/edited_mesh.h"

#include <algorithm>
#include <utility>

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
  if (at_[b].size() < at_[a].size()) std::swap(a, b);  // in a fan of needles one has hundreds
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

EditedMesh::VertexId EditedMesh::split(FacetId t, const Vec3& at) {
  keep();
  const auto [a, b, c] = facets_[t];
  const VertexId v = positions_.next_id();
  positions_.push_back(at);
  at_.emplace_back();
  set(t, {a, b, v});
  add({b, c, v});
  add({c, a, v});
  return v;
}

EditedMesh::VertexId EditedMesh::split(VertexId a, VertexId b, const Vec3& at) {
  keep();
  const VertexId v = positions_.next_id();
  positions_.push_back(at);
  at_.emplace_back();
  for (const FacetId t : std::vector<FacetId>(at_[a])) {
    Facet near = facets_[t], far = near;
    if (std::ranges::find(near, b) == near.end()) continue;
    std::ranges::replace(near, b, v);
    std::ranges::replace(far, a, v);
    set(t, near);
    add(far);
  }
  return v;
}

std::vector<EditedMesh::VertexId> EditedMesh::neighbours(VertexId v) const {
  std::vector<VertexId> found;
  for (const FacetId t : at_[v])
    for (const VertexId w : facets_[t])
      if (w != v) found.push_back(w);
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool EditedMesh::can_collapse(VertexId v, VertexId w) const {
  std::vector<VertexId> thirds, around;  // the latter once for each facet
  for (const FacetId t : at_[v]) {
    const bool is_beside = std::ranges::find(facets_[t], w) != facets_[t].end();
    if (is_beside) thirds.push_back(third(t, v, w));
    for (const VertexId u : facets_[t])
      if (u != v && u != w) around.push_back(u);
  }
  if (thirds.empty() || thirds.size() > 2) return false;
  std::ranges::sort(thirds);
  std::ranges::sort(around);
  std::size_t common = 0;
  for (auto u = around.begin(), end = u; u != around.end(); u = end) {
    end = std::find_if(u, around.end(), [&](VertexId other) { return other != *u; });
    if (thirds.size() == 2 && end - u == 1) return false;  // two borders would meet, or one leave its place
    if (!has_edge(*u, w)) continue;
    if (std::ranges::find(thirds, *u) == thirds.end()) return false;
    ++common;
  }
  if (common < thirds.size()) return false;  // both of them are one
  return !has_twin_facet(v, w, thirds) && (at_[w].size() > thirds.size() || at_[v].size() > thirds.size());
}

/// Would a facet of v become one that w has, as of a tetrahedron? Its other corners are joined to both.
bool EditedMesh::has_twin_facet(VertexId v, VertexId w, const std::vector<VertexId>& thirds) const {
  if (thirds.size() < 2) return false;
  const auto has_both = [&](FacetId t) {
    return std::ranges::all_of(
        thirds, [&](VertexId u) { return std::ranges::find(facets_[t], u) != facets_[t].end(); });
  };
  return std::ranges::any_of(at_[v], has_both) && std::ranges::any_of(at_[w], has_both);
}

void EditedMesh::collapse(VertexId v, VertexId w) {
  keep();
  for (const FacetId t : std::vector<FacetId>(at_[v])) {
    Facet f = facets_[t];
    if (std::ranges::find(f, w) != f.end()) {
      for (const VertexId corner : f) std::erase(at_[corner], t);
      facets_[t] = Facet();
    } else {
      std::ranges::replace(f, v, w);
      set(t, f);
    }
  }
}

EditedMesh::FacetId EditedMesh::add(const Facet& facet) {
  const FacetId t = facets_.next_id();
  facets_.push_back(facet);
  for (const VertexId v : facet) at_[v].push_back(t);
  return t;
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
  geom::Table<FacetId, Facet> facets;
  facets.reserve(facets_.size());
  for (const Facet& f : facets_)
    if (f[0].valid()) facets.push_back(f);
  for (Facet& f : facets) std::rotate(f.begin(), std::ranges::min_element(f), f.end());
  std::ranges::sort(facets);
  return TriMesh(positions_, std::move(facets));
}

}  // namespace fpo
