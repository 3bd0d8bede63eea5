#include "fpo/features/curve_slides.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// A cylinder's rims or a cube's edges with their samples, and others.
struct Scene {
  explicit Scene(const char* name, std::size_t n = 300)
      : mesh(geom::make_shape(name)),
        sizing(fixtures::even(mesh, n)),
        features(find_features(mesh)),
        on_curves(sample_features(mesh, features, {}, sizing, {n, 1})),
        slides(mesh, features, on_curves, sizing),
        domain(mesh, sizing, all(n), {.num_fixed = on_curves.samples.size()}) {}

  std::vector<SurfaceSample> all(std::size_t n) const {
    std::vector<SurfaceSample> samples = on_curves.samples;
    for (const SurfaceSample& x : random_samples(mesh, n - samples.size(), 1)) samples.push_back(x);
    return samples;
  }

  TriMesh mesh;
  Sizing sizing;
  Features features;
  FeatureSamples on_curves;
  CurveSlides slides;
  SurfaceDomain domain;
};

}  // namespace

TEST_CASE("curve slides: corners and inner samples stay, others slide along their curve within bounds") {
  for (const char* name : {"cube", "cylinder"}) {
    CAPTURE(name);
    const Scene scene(name);
    std::size_t sliding = 0;
    for (std::size_t i = 0; i < scene.domain.num_samples(); ++i) {
      const SiteId x(i);
      const bool on_curve = i >= scene.on_curves.num_given && i < scene.on_curves.samples.size();
      REQUIRE(scene.slides.can_slide(x) == on_curve);
      if (!on_curve) continue;
      ++sliding;
      const std::vector<SurfaceSample> places = scene.slides.places(scene.domain, x);
      CHECK(!places.empty());
      const double h = scene.sizing.at(scene.domain.sample(x));
      for (const SurfaceSample& place : places) {
        CHECK((place.position - scene.domain.sample(x).position).norm() <= 0.34 * h);
        double off = 1e300;  // from all curves
        for (const FeatureCurve& curve : scene.features.curves)
          off = std::min(off, CurveMetric(scene.mesh, curve, scene.sizing).nearest(place.position).distance2);
        CHECK(off < 1e-20);
        const auto& f = scene.mesh.facet(place.facet);
        CHECK(geom::closest_point(place.position, {scene.mesh.position(f[0]), scene.mesh.position(f[1]),
                                                   scene.mesh.position(f[2])})
                  .distance2 < 1e-20);
      }
    }
    CHECK(sliding > 20);
  }
}

TEST_CASE("curve slides: steps that are asked for are those that are made, or none") {
  const Scene scene("cylinder");
  std::size_t made = 0;
  for (std::size_t i = scene.on_curves.num_given; i < scene.on_curves.samples.size(); ++i) {
    const SiteId x(i);
    if (!scene.slides.can_slide(x)) continue;
    const auto [before, after] = scene.slides.neighbours(x);
    const SurfaceSample& now = scene.domain.sample(x);
    const std::array<Vec3, 2> beside{scene.domain.sample(before).position,
                                     scene.domain.sample(after).position};
    for (const double step : {-0.2, -0.004, 0.004, 0.2}) {
      const std::vector<SurfaceSample> places = scene.slides.places(x, now, beside, {&step, 1});
      REQUIRE(places.size() <= 1);
      if (places.empty()) continue;
      ++made;
      const double way = (places[0].position - now.position).norm();  // the rims are fine polygons
      CHECK(way == doctest::Approx(std::abs(step) * scene.sizing.at(now)).epsilon(0.01));
    }
  }
  CHECK(made > 20);
}

TEST_CASE("curve slides: a sample put between two neighbours on a curve is seen") {
  Scene scene("cube");
  const std::vector<SiteId>& chain = scene.on_curves.chains[0];
  REQUIRE(chain.size() > 4);
  const SiteId a = chain[1], b = chain[2];
  const SiteId inner(scene.on_curves.samples.size());
  SurfaceSample middle = scene.domain.sample(a);
  middle.position = (middle.position + scene.domain.sample(b).position) / 2;
  scene.domain.remove(inner);
  scene.domain.insert_at(inner, middle, 1);
  CHECK(!scene.slides.has_its_edges(scene.domain, a));
  CHECK(!scene.slides.has_its_edges(scene.domain, b));
}
