#include "geom/mesh/trimesh.h"

#include <algorithm>
#include <string>

#include "geom/check.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/edges.h"

namespace geom {
namespace {

constexpr std::size_t max_elements = std::size_t{1} << 30;

}  // namespace

TriMesh::TriMesh(Table<VertexId, Vec3> vertices, Table<FacetId, Facet> facets)
    : vertices_(std::move(vertices)), facets_(std::move(facets)) {
  require(vertices_.size() <= max_elements && facets_.size() <= max_elements,
          "the mesh has more than 2^30 elements");
  check_vertices();
  check_facets();
  find_box();
  Across across(facets_.size());
  for_each_edge(this->facets(), [&](auto first, auto last) {
    if (last - first != 2) return;
    const HalfEdge &a = first[0], &b = first[1];
    across[a.facet][static_cast<std::size_t>(a.edge)] = b.facet;
    across[b.facet][static_cast<std::size_t>(b.edge)] = a.facet;
  });
  across_ = SharedTable(std::move(across));
}

void TriMesh::check_vertices() const {
  for (VertexId v(0); v.index() < vertices_.size(); v = VertexId(v.value + 1))
    if (!vertices_[v].allFinite())
      throw InputError("vertex " + std::to_string(v.value) + " has a coordinate that is not finite");
}

void TriMesh::check_facets() const {
  for (FacetId t(0); t.index() < facets_.size(); t = FacetId(t.value + 1)) {
    const Facet& f = facets_[t];
    const auto fault = [&](const std::string& what) {
      return InputError("facet " + std::to_string(t.value) + " names " + what);
    };
    for (const VertexId v : f)
      if (!v.valid() || v.index() >= vertices_.size())
        throw fault("vertex " + std::to_string(v.value) + ", which does not exist");
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) throw fault("a vertex twice");
  }
}

void TriMesh::find_box() {
  box_.setEmpty();
  for (const Facet& f : facets())
    for (const VertexId v : f) box_.extend(vertices_[v]);
}

TriMesh TriMesh::with_vertices(Table<VertexId, Vec3> vertices) const {
  ensure(vertices.size() == num_vertices(), "vertices elsewhere: as many");
  TriMesh result = *this;
  result.vertices_ = SharedTable(std::move(vertices));
  result.levels_ = {};
  result.check_vertices();
  result.find_box();
  return result;
}

TriMesh TriMesh::with_levels(Table<VertexId, double> levels) const {
  ensure(levels.empty() || levels.size() == num_vertices(), "levels: one a vertex");
  TriMesh result = *this;
  result.levels_ = SharedTable(std::move(levels));
  return result;
}

Vec3 TriMesh::normal(FacetId t) const {
  return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
}

double TriMesh::area() const {
  double sum = 0;
  for (FacetId t(0); t.index() < num_facets(); t = FacetId(t.value + 1)) sum += area(t);
  return sum;
}

// A vertex is manifold if its facets, joined across edges at the vertex that have two facets, form one set,
// and none of those edges has three: then they are a disk or a fan. Boundary loops are the components of the
// boundary edges.
Topology topology(const TriMesh& mesh) {
  Topology result;
  result.facets = mesh.num_facets();
  const std::size_t v_count = mesh.num_vertices();
  DisjointSets components(v_count), loops(v_count);
  DisjointSets fans(3 * mesh.num_facets());  // facet corners, joined around each vertex
  const auto corner_at = [&](FacetId t, VertexId v) {
    const TriMesh::Facet& f = mesh.facet(t);
    return 3 * t.index() + static_cast<std::size_t>(std::ranges::find(f, v) - f.begin());
  };
  std::vector<char> used(v_count, 0), on_boundary(v_count, 0), bad(v_count, 0);

  for_each_edge(mesh, [&](auto first, auto last) {
    ++result.edges;
    const VertexId low = first->low, high = first->high;
    used[low.index()] = used[high.index()] = 1;
    components.merge(low.index(), high.index());
    if (last - first == 1) {
      ++result.boundary_edges;
      on_boundary[low.index()] = on_boundary[high.index()] = 1;
      loops.merge(low.index(), high.index());
    } else if (last - first == 2) {
      result.misoriented_edges += first[0].ascending == first[1].ascending;
      for (const VertexId v : {low, high})
        fans.merge(corner_at(first[0].facet, v), corner_at(first[1].facet, v));
    } else {
      ++result.nonmanifold_edges;
      bad[low.index()] = bad[high.index()] = 1;
    }
  });

  std::vector<std::size_t> fan_of(v_count, 3 * mesh.num_facets());
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t v = mesh.facet(t)[i].index(), fan = fans.find(3 * t.index() + i);
      if (fan_of[v] == 3 * mesh.num_facets()) fan_of[v] = fan;
      if (fan_of[v] != fan) bad[v] = 1;
    }
  for (std::size_t v = 0; v < v_count; ++v) {
    result.vertices += used[v];
    result.unreferenced_vertices += !used[v];
    result.nonmanifold_vertices += bad[v];
    result.components += used[v] && components.find(v) == v;
    result.boundary_loops += on_boundary[v] && loops.find(v) == v;
  }
  result.euler =
      static_cast<long>(result.vertices) - static_cast<long>(result.edges) + static_cast<long>(result.facets);
  return result;
}

}  // namespace geom
