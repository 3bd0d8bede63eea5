#include "fpo/measure/covering.h"

#include <algorithm>
#include <limits>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

std::vector<Vec3> positions(const std::vector<SurfaceSample>& samples) {
  std::vector<Vec3> result;
  for (const SurfaceSample& x : samples) result.push_back(x.position);
  return result;
}

}  // namespace

TEST_CASE("covering: no location is farther than it says, and some are nearly as far") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const std::vector<Vec3> samples = positions(random_samples(mesh, 25, 4));
    std::vector<double> sizes = nearest_distances(samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < samples.size(); ++j)
        if (j != i) least = std::min(least, (samples[i] - samples[j]).norm());
      CHECK(sizes[i] == doctest::Approx(least));
    }
    const Covering found = covering(mesh, samples, sizes, 2);
    double radius = 0, factor = 0;
    std::vector<Vec3> places = positions(random_samples(mesh, 20000, 7));
    places.insert(places.end(), mesh.vertices().begin(), mesh.vertices().end());
    for (const Vec3& x : places) {
      double nearest = std::numeric_limits<double>::infinity(), ratio = nearest;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        nearest = std::min(nearest, (x - samples[i]).norm());
        ratio = std::min(ratio, (x - samples[i]).norm() / sizes[i]);
      }
      radius = std::max(radius, nearest), factor = std::max(factor, ratio);
    }
    CHECK(found.radius >= radius * (1 - 1e-12));
    CHECK(found.local_ratio >= factor * (1 - 1e-9));
    CHECK(found.radius < 1.06 * radius);
    CHECK(found.local_ratio < 1.06 * factor);
    CHECK(found.ratio == doctest::Approx(found.radius / *std::ranges::min_element(sizes)));
  }
}

TEST_CASE("covering: equal sizes make both the same; samples that coincide; a single one; none") {
  const TriMesh mesh = fixtures::tilted_square(3);
  std::vector<Vec3> samples = positions(random_samples(mesh, 12, 2));
  const std::vector<double> even(12, 0.25);
  const Covering found = covering(mesh, samples, even, 1);
  CHECK(found.local_ratio == doctest::Approx(found.radius / 0.25));
  samples[3] = samples[8];
  const Covering twins = covering(mesh, samples, nearest_distances(samples), 1);
  CHECK(twins.ratio == 0);
  CHECK(twins.local_ratio > 0);
  const std::vector<Vec3> one(1, samples[0]);
  CHECK(covering(mesh, one, nearest_distances(one), 1).local_ratio == 0);
  CHECK(covering(mesh, one, nearest_distances(one), 1).radius > 0);
  CHECK_THROWS_AS(covering(mesh, {}, {}, 1), geom::InputError);
}

TEST_CASE("covering: samples far outside the surface's box") {
  const TriMesh mesh = fixtures::tilted_square(2), sphere = geom::make_shape("sphere", 6);
  for (const double far : {3.0, 60.0, 1e3, 1e8}) {
    CAPTURE(far);
    std::vector<Vec3> samples;
    for (const Vec3& p : sphere.vertices()) samples.push_back(geom::snapped(far * p));
    const Covering found = covering(mesh, samples, nearest_distances(samples), 1);
    double most = 0;
    for (const Vec3& x : mesh.vertices()) {
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3& p : samples) least = std::min(least, (x - p).norm());
      most = std::max(most, least);
    }
    CHECK(found.radius >= most * (1 - 1e-9));
    CHECK(found.radius <= most + mesh.diagonal());
  }
}
