#include "geom/mesh/trimesh.h"

#include <algorithm>
#include <string>

#include "geom/check.h"
#include "geom/disjoint_sets.h"
#include "geom/mesh/edges.h"
#include "geom/mesh/vertex_fans.h"

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

// A vertex is manifold if its facets are one fan or one disk. Boundary loops are the components of the
// boundary edges.
Topology topology(const TriMesh& mesh) {
  Topology result;
  result.facets = mesh.num_facets();
  const VertexFans fans(mesh);
  DisjointSets components(mesh.num_vertices()), loops(0);
  std::vector<char> on_boundary;  // both of no size if there is none
  for_each_edge(mesh, [&](auto first, auto last) {
    ++result.edges;
    const std::size_t low = first->low.index(), high = first->high.index();
    components.merge(low, high);
    if (last - first == 1) {
      ++result.boundary_edges;
      if (on_boundary.empty()) {
        on_boundary.assign(mesh.num_vertices(), 0);
        loops = DisjointSets(mesh.num_vertices());
      }
      on_boundary[low] = on_boundary[high] = 1;
      loops.merge(low, high);
    } else if (last - first == 2) {
      result.misoriented_edges += first[0].ascending == first[1].ascending;
    } else {
      ++result.nonmanifold_edges;
    }
  });
  for (VertexId v(0); v.index() < mesh.num_vertices(); v = VertexId(v.value + 1)) {
    const bool is_used = fans.num_facets(v) > 0;
    result.vertices += is_used;
    result.unreferenced_vertices += !is_used;
    result.nonmanifold_vertices += !fans.is_manifold(v);
    result.components += is_used && components.find(v.index()) == v.index();
    result.boundary_loops +=
        !on_boundary.empty() && on_boundary[v.index()] && loops.find(v.index()) == v.index();
  }
  result.euler =
      static_cast<long>(result.vertices) - static_cast<long>(result.edges) + static_cast<long>(result.facets);
  return result;
}

}  // namespace geom
