#include "geom/mesh/vertex_fans.h"

namespace geom {
namespace {

/// The corner of a facet that is neither of two others.
VertexId third(const TriMesh::Facet& f, VertexId a, VertexId b) {
  for (std::size_t i = 0; i < 2; ++i)
    if (f[i] != a && f[i] != b) return f[i];
  return f[2];
}

}  // namespace

VertexFans::VertexFans(const TriMesh& mesh)
    : mesh_(mesh), num_facets_(mesh.num_vertices(), 0), facet_of_(mesh.num_vertices()) {
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (const VertexId v : mesh.facet(t)) {
      ++num_facets_[v];
      facet_of_[v] = t;
    }
}

VertexFans::Step VertexFans::next(VertexId v, const Step& step) const {
  const TriMesh::Facet& f = mesh_.facet(step.facet);
  for (int e = 0; e < 3; ++e) {
    const VertexId a = f[static_cast<std::size_t>(e)], b = f[static_cast<std::size_t>(e == 2 ? 0 : e + 1)];
    if (!(a == v && b == step.over) && !(a == step.over && b == v)) continue;
    const FacetId across = mesh_.across(step.facet, e);
    return {across, across.valid() ? third(mesh_.facet(across), v, step.over) : VertexId()};
  }
  return {};
}

VertexFans::Fan VertexFans::at(VertexId v) const {
  const FacetId first = facet_of_[v];
  const TriMesh::Facet& f = mesh_.facet(first);
  std::size_t met = 1;
  bool is_doubled = false;
  for (const VertexId over : f) {  // both ways from the first one
    if (over == v) continue;
    VertexId behind = third(f, v, over);
    for (Step step = next(v, {first, over}), last{first, over}; step.facet.valid(); step = next(v, last)) {
      is_doubled |= step.over == behind;
      if (step.facet == first) return {met == num_facets_[v], is_doubled};  // a disk
      ++met;
      behind = last.over;
      last = step;
    }
  }
  return {met == num_facets_[v], is_doubled};
}

}  // namespace geom
