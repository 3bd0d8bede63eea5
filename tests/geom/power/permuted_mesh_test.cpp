// The diagram is one of a surface, not of a file: with facets and vertices in another order, and every facet
// starting at another corner, it is the same up to the new names.

#include <algorithm>
#include <numeric>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/power/restricted_power.h"
#include "geom/rng.h"
#include "geom/sites/site_tree.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;

namespace {

using Canonical = RestrictedPower::Canonical;

/// A mesh with other names for its parts.
struct Renamed {
  TriMesh mesh;
  std::vector<FacetId> old_facet;  ///< by new facet
  std::vector<int> turn;           ///< corner i of a new facet is corner i + turn of the old one
};

Renamed renamed(const TriMesh& mesh, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<std::size_t> vertex_order(mesh.num_vertices()), facet_order(mesh.num_facets());
  std::iota(vertex_order.begin(), vertex_order.end(), 0);
  std::iota(facet_order.begin(), facet_order.end(), 0);
  rng.shuffle(std::span(vertex_order));
  rng.shuffle(std::span(facet_order));
  std::vector<VertexId> new_vertex(mesh.num_vertices());
  Table<VertexId, Vec3> vertices;
  for (const std::size_t old : vertex_order) {
    new_vertex[old] = vertices.next_id();
    vertices.push_back(mesh.vertices()[VertexId(old)]);
  }
  Renamed result;
  Table<FacetId, TriMesh::Facet> facets;
  for (const std::size_t old : facet_order) {
    const auto turn = static_cast<int>(rng.below(3));
    TriMesh::Facet facet;
    for (std::size_t i = 0; i < 3; ++i)
      facet[i] = new_vertex[mesh.facets()[FacetId(old)][(i + static_cast<std::size_t>(turn)) % 3].index()];
    facets.push_back(facet);
    result.old_facet.emplace_back(old);
    result.turn.push_back(turn);
  }
  result.mesh = TriMesh(std::move(vertices), std::move(facets));
  return result;
}

/// The diagram of the new mesh in the names of the old one.
std::vector<Canonical> in_old_names(std::vector<Canonical> diagram, const Renamed& by) {
  for (Canonical& fragment : diagram) {
    const int turn = by.turn[fragment.facet.index()];
    for (EdgeLabel& label : fragment.labels)
      if (!label.is_site()) label = EdgeLabel::facet_edge((label.edge() + turn) % 3);
    std::rotate(fragment.labels.begin(), std::ranges::min_element(fragment.labels), fragment.labels.end());
    fragment.facet = by.old_facet[fragment.facet.index()];
  }
  std::ranges::sort(diagram);
  return diagram;
}

std::vector<Canonical> diagram_of(const TriMesh& mesh, const std::vector<WeightedPoint3>& sites) {
  SiteTree tree;
  for (std::size_t i = 0; i < sites.size(); ++i) tree.insert(SiteId(i), sites[i]);
  const RestrictedPower power(mesh, sites, tree);
  power.check();
  return power.canonical();
}

std::vector<WeightedPoint3> weighted_samples(const TriMesh& mesh, std::size_t n) {
  Rng rng(n);
  std::vector<WeightedPoint3> sites;
  for (const fpo::SurfaceSample& s : fpo::random_samples(mesh, n, n))
    sites.push_back({s.position, 0.3 * mesh.area() / static_cast<double>(n) * rng.uniform()});
  return sites;
}

/// All corners of facets, middles of edges and of facets: as many ties as can be.
std::vector<WeightedPoint3> symmetric_sites(const TriMesh& mesh) {
  std::vector<WeightedPoint3> sites;
  for (const Vec3& x : mesh.vertices()) sites.push_back({x, 0});
  for (FacetId t(0); t.index() < std::min<std::size_t>(mesh.num_facets(), 60); t = FacetId(t.value + 1))
    sites.push_back({(mesh.corner(t, 0) + mesh.corner(t, 1)) / 2, 0});
  return sites;
}

}  // namespace

TEST_CASE("restricted power diagram: the same with facets, vertices and corners in any other order") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    for (const auto& sites : {weighted_samples(surface.mesh, 40), weighted_samples(surface.mesh, 150),
                              symmetric_sites(surface.mesh)}) {
      const std::vector<Canonical> expected = diagram_of(surface.mesh, sites);
      for (const std::uint64_t seed : {1, 2, 3}) {
        CAPTURE(seed);
        const Renamed other = renamed(surface.mesh, seed);
        CHECK(in_old_names(diagram_of(other.mesh, sites), other) == expected);
      }
    }
  }
}
