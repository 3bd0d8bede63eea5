// The samples that a remesh begins with.

#include "fpo/remesh/start.h"

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/sizings.h"

using namespace fpo;

TEST_CASE("start: those on features first and the rest at random; inner ones are taken from others") {
  const geom::TriMesh cube = geom::make_shape("cube");
  const Features features = find_features(cube);
  const Sizing sizing = fixtures::even(cube, 200);
  const SharedSizing shared{sizing, sample_features(cube, features, {}, sizing, {200, 1})};
  const std::size_t fixed = shared.features.samples.size();
  const std::vector<SurfaceSample> a = initial_samples(cube, shared, 200, 1);
  std::vector<SurfaceSample> b = initial_samples(cube, shared, 200, 2);
  REQUIRE(a.size() == 200);
  REQUIRE(fixed < 150);
  for (std::size_t i = 0; i < fixed; ++i) CHECK(a[i].position == b[i].position);
  CHECK(!(a[fixed].position == b[fixed].position));
  const std::vector<SurfaceSample> before = b;
  take_inner(a, fixed + 10, fixed, b);  // ten fewer
  for (std::size_t i = 0; i < 200; ++i)
    CHECK(b[i].position == (i < fixed || i >= 190 ? before[i] : a[i + 10]).position);
  take_inner(a, 300, fixed, b);  // none
  CHECK(b[fixed].position == a[fixed + 10].position);
}
