#include "fpo/remesh/emptied_balls.h"

#include <atomic>

#include "doctest.h"
#include "fpo/remesh/proven_edges.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"

using namespace fpo;
using geom::SiteId;
using geom::Vec3;

namespace {

/// The samples on the edges of a cube, and one on a face, beside the middle of the first edge.
struct Cube {
  explicit Cube(double share_of_radius) {
    samples = on_curves.samples;
    const std::vector<SiteId>& chain = on_curves.chains[0];
    const Vec3 a = samples[chain[0].index()].position, b = samples[chain[1].index()].position;
    const Vec3 middle = (a + b) / 2;
    const geom::AabbTree tree(mesh);
    const Vec3 aside = tree.closest(middle + Vec3(0.31, 0.29, 0.27)).point - middle;
    const auto at = tree.closest(middle + share_of_radius * (b - a).norm() / 2 * aside.normalized());
    samples.push_back({at.point, at.facet});
  }
  SurfaceDomain domain() const {
    return SurfaceDomain(mesh, sizing, samples, {.num_fixed = on_curves.samples.size()});
  }
  std::size_t num_open(const SurfaceDomain& domain) const {
    return open_balls(domain, features, on_curves).size();
  }
  std::size_t num_changed(const SurfaceDomain& domain) const {
    std::size_t changed = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      changed +=
          domain.weight_share(SiteId(i)) != 1 || domain.sample(SiteId(i)).position != samples[i].position;
    return changed;
  }

  geom::TriMesh mesh = geom::make_shape("cube");
  Sizing sizing = fixtures::even(mesh, 200);
  Features features = find_features(mesh);
  FeatureSamples on_curves = sample_features(mesh, features, {}, sizing, {200, 1});
  std::vector<SurfaceSample> samples;
};

}  // namespace

TEST_CASE("emptied balls: a sample at the border of a ball is outside of it with some more weight") {
  for (const double share : {0.5, 0.8, 0.95, 0.999}) {
    CAPTURE(share);
    const Cube cube(share);
    SurfaceDomain domain = cube.domain();
    REQUIRE(cube.num_open(domain) > 0);
    const std::size_t weighted = empty_balls(domain, cube.features, cube.on_curves);
    CHECK(cube.num_open(domain) == 0);
    CHECK(weighted >= 2);
    CHECK(weighted == cube.num_changed(domain));
    domain.check();
  }
}

TEST_CASE("emptied balls: nothing changes where all edges are proven, or a sample is too deep in a ball") {
  for (const double share : {0.0, 1.01, 1.5}) {
    CAPTURE(share);
    const Cube cube(share);
    SurfaceDomain domain = cube.domain();
    const std::size_t open = cube.num_open(domain);
    CHECK((open > 0) == (share < 1));
    CHECK(empty_balls(domain, cube.features, cube.on_curves) == 0);
    CHECK(cube.num_open(domain) == open);
    CHECK(cube.num_changed(domain) == 0);
  }
}

TEST_CASE("emptied balls: a sample that is too deep in a ball leaves, a fixed one and those outside stay") {
  for (const double share : {0.0, 0.2, 1.01}) {
    CAPTURE(share);
    const Cube cube(share);
    SurfaceDomain domain = cube.domain();
    const bool is_open = cube.num_open(domain) > 0;
    CHECK(is_open == (share < 1));
    CHECK(send_out_of_balls(domain, cube.features, cube.on_curves, nullptr) == (is_open ? 1 : 0));
    CHECK(cube.num_open(domain) == 0);
    CHECK(cube.num_changed(domain) == (is_open ? 1 : 0));
    domain.check();

    SurfaceDomain fixed(cube.mesh, cube.sizing, cube.samples, {.num_fixed = cube.samples.size()});
    CHECK(send_out_of_balls(fixed, cube.features, cube.on_curves, nullptr) == 0);
    CHECK(cube.num_changed(fixed) == 0);
    const std::atomic<bool> interrupted = true;
    SurfaceDomain stopped = cube.domain();
    CHECK(send_out_of_balls(stopped, cube.features, cube.on_curves, &interrupted) == 0);
  }
}
