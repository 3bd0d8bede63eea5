#include "fpo/remesh/proven_edges.h"

#include <algorithm>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

struct Part {
  Part(const char* name, std::size_t n)
      : mesh(geom::make_shape(name)),
        sizing(fixtures::even(mesh, n)),
        features(find_features(mesh)),
        on_curves(sample_features(mesh, features, {}, sizing, {n, 1})),
        samples(on_curves.samples) {
    for (const SurfaceSample& x : random_samples(mesh, n - samples.size(), 1)) samples.push_back(x);
  }
  SurfaceDomain domain() const {
    return SurfaceDomain(mesh, sizing, samples, {.num_fixed = on_curves.samples.size()});
  }
  std::size_t edges_in(const SurfaceDomain& domain) const {
    std::size_t count = 0;
    std::vector<SiteId> link;
    for (const std::vector<SiteId>& chain : on_curves.chains)
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        domain.dual().link(chain[i], link);
        count += std::ranges::find(link, chain[i + 1]) != link.end();
      }
    return count;
  }

  TriMesh mesh;
  Sizing sizing;
  Features features;
  FeatureSamples on_curves;
  std::vector<SurfaceSample> samples;
};

}  // namespace

TEST_CASE("proven edges: all of them on parts with enough samples, and never more than there are") {
  for (const char* name : {"cube", "cylinder", "joint", "star"}) {
    CAPTURE(name);
    const Part part(name, 400);
    SurfaceDomain domain = part.domain();
    CHECK(num_proven_edges(domain, part.features, part.on_curves) <= part.edges_in(domain));
    OptimizeOptions options;
    options.max_iterations = 10;
    optimize(domain, options);
    const std::size_t proven = num_proven_edges(domain, part.features, part.on_curves);
    CHECK(proven <= part.edges_in(domain));
    if (name[0] == 'c') CHECK(proven == num_edges(part.on_curves));
  }
}

TEST_CASE(
    "proven edges: a sample in the middle of an edge takes the proof away, one outside of the ball does "
    "not") {
  Part part("cube", 200);
  const std::vector<SiteId>& chain = part.on_curves.chains[0];
  const Vec3 a = part.on_curves.samples[chain[0].index()].position,
             b = part.on_curves.samples[chain[1].index()].position, middle = (a + b) / 2;
  const geom::AabbTree tree(part.mesh);
  const Vec3 aside = tree.closest(middle + Vec3(0.31, 0.29, 0.27)).point - middle;
  part.samples.resize(part.on_curves.samples.size());  // the edges' alone
  const std::size_t all = num_edges(part.on_curves);
  REQUIRE(num_proven_edges(part.domain(), part.features, part.on_curves) == all);
  const double radius = (b - a).norm() / 2;
  for (const double share : {0.0, 0.5, 0.98, 1.02, 1.5}) {
    CAPTURE(share);
    const auto at = tree.closest(middle + share * radius * aside.normalized());
    part.samples.push_back({at.point, at.facet});
    const double distance = (at.point - middle).norm();
    CHECK((num_proven_edges(part.domain(), part.features, part.on_curves) < all) == (distance < radius));
    part.samples.pop_back();
  }
}
