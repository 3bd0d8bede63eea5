#include "fpo/remesh/protect.h"

#include <algorithm>
#include <array>
#include <vector>

#include "doctest.h"
#include "fpo/optimize.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::Vec3;

namespace {

constexpr double h = 0.1;

/// On the unit square: samples of features at these places, two by two ends of an edge, and others,
/// optimized.
struct Scene {
  explicit Scene(const std::vector<std::array<double, 2>>& ends)
      : domain(mesh, Sizing::uniform(h), all(ends), options(ends)) {
    OptimizeOptions few;
    few.max_iterations = 10;
    optimize(domain, few);
    features.samples.assign(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(ends.size()));
    for (std::size_t i = 0; i < ends.size(); i += 2) features.chains.push_back({SiteId(i), SiteId(i + 1)});
  }
  static geom::TriMesh square() {
    geom::Table<geom::VertexId, Vec3> vertices;
    geom::Table<FacetId, geom::TriMesh::Facet> facets;
    fixtures::add_grid(vertices, facets, 1, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    return geom::TriMesh(std::move(vertices), std::move(facets));
  }
  static SurfaceOptions options(const std::vector<std::array<double, 2>>& ends) {
    return {.num_fixed = ends.size()};
  }
  const std::vector<SurfaceSample>& all(const std::vector<std::array<double, 2>>& ends) {
    for (const auto& [x, y] : ends) samples.push_back({Vec3(x, y, 0), FacetId(x >= y ? 0 : 1)});
    for (const SurfaceSample& x : random_samples(mesh, 100, 5)) samples.push_back(x);
    return samples;
  }
  bool has_edge(SiteId a, SiteId b) const {
    std::vector<SiteId> link;
    domain.dual().link(a, link);
    return std::ranges::find(link, b) != link.end();
  }

  geom::TriMesh mesh = square();
  std::vector<SurfaceSample> samples;
  SurfaceDomain domain;
  FeatureSamples features;
};

}  // namespace

TEST_CASE("protection: an edge that others come between is made one") {
  Scene scene({{0.4, 0.5}, {0.6, 0.5}});
  REQUIRE(!scene.has_edge(SiteId(0), SiteId(1)));
  CHECK(protect_chains(scene.domain, scene.features).weighted == 2);
  CHECK(scene.has_edge(SiteId(0), SiteId(1)));
  scene.domain.check();
}

TEST_CASE("protection: weights are not raised so far that other samples of features lose their places") {
  // Half the long edge is longer than the way from its first end to an end of the short one.
  Scene scene({{0.4, 0.5}, {0.65, 0.5}, {0.4, 0.57}, {0.4, 0.66}});
  REQUIRE(!scene.has_edge(SiteId(0), SiteId(1)));
  protect_chains(scene.domain, scene.features);
  for (std::size_t i = 0; i < 4; ++i) CHECK(scene.domain.dual().has_cell(SiteId(i)));
  CHECK(scene.has_edge(SiteId(2), SiteId(3)));
  scene.domain.check();
}
