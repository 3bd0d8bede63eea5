// Where edges of features are missing, and how many samples would do.

#include "fpo/remesh/edge_advice.h"

#include "doctest.h"
#include "fpo/features/feature_samples.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// A chain 0, 1 along x from 0 to 1, which the edge from vertex 2 to 3 crosses this far from its middle.
TriMesh crossed(double distance) {
  geom::Table<VertexId, Vec3> vertices;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, distance, 0), Vec3(0.5, -distance, 0)})
    vertices.push_back(p);
  geom::Table<geom::FacetId, TriMesh::Facet> facets;
  facets.push_back({VertexId(0), VertexId(3), VertexId(2)});
  facets.push_back({VertexId(1), VertexId(2), VertexId(3)});
  return TriMesh(vertices, facets);
}

FeatureSamples chain_of(const TriMesh& mesh) {
  FeatureSamples samples;
  for (std::size_t v = 0; v < 4; ++v)
    samples.samples.push_back({mesh.position(VertexId(v)), geom::FacetId(0)});
  samples.chains = {{SiteId(2), SiteId(3)}, {SiteId(0), SiteId(1)}};
  return samples;
}

}  // namespace

TEST_CASE("edge advice: the middle of the first missing edge, and samples for balls as small as the strip") {
  for (const double distance : {0.25, 0.125}) {
    const TriMesh mesh = crossed(distance);
    const auto missing = broken_edges(mesh, chain_of(mesh));
    REQUIRE(missing.size() == 1);
    CHECK(missing[0] == std::pair(SiteId(0), SiteId(1)));
    const EdgeAdvice advice = edge_advice(mesh, missing);
    CHECK(advice.first == Vec3(0.5, 0, 0));
    const double shorter = 0.5 / distance;  // edges by this factor
    CHECK(advice.samples == static_cast<std::size_t>(4 * shorter * shorter));
  }
  const TriMesh near = crossed(1e-9);
  CHECK(edge_advice(near, broken_edges(near, chain_of(near))).samples == 4 * 36);
}

TEST_CASE("edge advice: none where no edge is missing") {
  const TriMesh mesh = crossed(0.25);
  FeatureSamples samples = chain_of(mesh);
  samples.chains.pop_back();
  CHECK(broken_edges(mesh, samples).empty());
  CHECK(edge_advice(mesh, {}).samples == 0);
}
