// Edges of curves made by flips.

#include "fpo/remesh/recovered_edges.h"

#include <numbers>

#include "doctest.h"
#include "fpo/remesh/edited_mesh.h"
#include "geom/rng.h"
#include "geom/shapes/shapes.h"

using namespace fpo;
using geom::FacetId;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

constexpr std::size_t around = 40;
constexpr double thickness = 0.06;  // of a disk of radius 1, whose edges along the rim are .157 long

/// A flat can: both rims, then both centers, and rings between these.
geom::Table<VertexId, Vec3> can_vertices() {
  geom::Table<VertexId, Vec3> vertices;
  for (const double z : {0.0, thickness})
    for (std::size_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + (z > 0 ? 0.5 : 0)) / around;
      vertices.push_back(Vec3(std::cos(angle), std::sin(angle), z));
    }
  vertices.push_back(Vec3(0, 0, 0)), vertices.push_back(Vec3(0, 0, thickness));
  return vertices;
}

TriMesh can() {
  geom::Table<FacetId, TriMesh::Facet> facets;
  const VertexId low(2 * around), high(2 * around + 1);
  for (std::size_t i = 0; i < around; ++i) {
    const VertexId a(i), b((i + 1) % around), c(around + i), d(around + (i + 1) % around);
    facets.push_back({a, b, c}), facets.push_back({b, d, c});
    facets.push_back({b, a, low}), facets.push_back({c, d, high});
  }
  return TriMesh(can_vertices(), facets);
}

FeatureSamples rims(const TriMesh& mesh) {
  FeatureSamples samples;
  for (const Vec3& x : mesh.vertices()) samples.samples.push_back({x, FacetId(0)});
  samples.chains.resize(2);
  for (std::size_t rim : {0u, 1u})
    for (std::size_t i = 0; i <= around; ++i) samples.chains[rim].emplace_back(rim * around + i % around);
  return samples;
}

/// With edges of the rims flipped: so many of 80, spread by a seed.
TriMesh spoilt(const TriMesh& mesh, double share, std::uint64_t seed) {
  EditedMesh edited(mesh);
  geom::Rng rng(seed);
  for (const auto& [a, b] : chain_edges(rims(mesh)))
    if (rng.uniform() < share && edited.can_flip(a, b)) edited.flip(a, b);
  return edited.mesh();
}

}  // namespace

TEST_CASE(
    "recovered edges: all of a thin can's rims, however many were lost, with vertices and type as they "
    "were") {
  const TriMesh mesh = can();
  const FeatureSamples samples = rims(mesh);
  REQUIRE(geom::topology(mesh).manifold());
  REQUIRE(broken_edges(mesh, samples).empty());
  for (const double share : {0.1, 0.5, 1.0})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const TriMesh lossy = spoilt(mesh, share, seed);
      const std::size_t lost = broken_edges(lossy, samples).size();
      CAPTURE(lost);
      CHECK(lost > 0);
      const auto [found, made] = recover_edges(lossy, samples);
      CHECK(broken_edges(found, samples).empty());
      CHECK(made == lost);
      CHECK(found.vertices() == mesh.vertices());
      const geom::Topology t = geom::topology(found);
      CHECK(t.manifold());
      CHECK(t.euler == 2);
      CHECK(t.misoriented_edges == 0);
    }
}

TEST_CASE("recovered edges: nothing changes where none is missing, or where triangles would be folded back") {
  const TriMesh mesh = can();
  const auto [same, none] = recover_edges(mesh, rims(mesh));
  CHECK(none == 0);
  CHECK(same.facets() == mesh.facets());

  // The quadrilateral 0, 1, 2, 3 is not convex at 1: the edge from 0 to 2 would lie outside.
  geom::Table<VertexId, Vec3> vertices;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.5, 0.4, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0)})
    vertices.push_back(p);
  geom::Table<FacetId, TriMesh::Facet> facets;
  facets.push_back({VertexId(0), VertexId(1), VertexId(3)});
  facets.push_back({VertexId(1), VertexId(2), VertexId(3)});
  const TriMesh dart(vertices, facets);
  FeatureSamples across = rims(mesh);
  across.chains = {{SiteId(0), SiteId(2)}};
  const auto [kept, made] = recover_edges(dart, across);
  CHECK(made == 0);
  CHECK(kept.facets() == dart.facets());
}
