// Facets turned.

#include "geom/repair/orient.h"

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/spoilt.h"
#include "tests/fixtures/surfaces.h"
#include "tests/fixtures/volume.h"
#include "tests/io/sample_meshes.h"

namespace {

using namespace fixtures;

TriMesh oriented(const TriMesh& mesh, geom::Orientation* done = nullptr) {
  MeshArrays arrays = fixtures::arrays_of(mesh);
  const geom::Orientation result = geom::orient(arrays.vertices, arrays.facets);
  if (done) *done = result;
  return arrays.take();
}

}  // namespace

TEST_CASE("orient: flipped facets are turned back, sound meshes stay") {
  Rng rng(8);
  for (const char* name : {"sphere", "torus", "tube", "double-torus", "two-spheres"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    CHECK(fixtures::identical(oriented(mesh), mesh));
    const TriMesh result = oriented(fixtures::with_flips(mesh, 0.3, rng));
    CHECK(geom::topology(result).misoriented_edges == 0);
    CHECK(volume(result) == doctest::Approx(volume(mesh)));
  }
}

TEST_CASE("orient: closed parts face outwards, but for cavities") {
  const TriMesh box = fixtures::box(Vec3(1, 2, 3), 1);
  Rng rng(1);
  const TriMesh inside_out = fixtures::with_flips(box, 1, rng);
  geom::Orientation done;
  CHECK(volume(oriented(inside_out, &done)) == doctest::Approx(6));
  CHECK(done.parts_turned == 1);
  CHECK(done.inverted == 0);
  const TriMesh hollow = geom::joined(
      box, geom::mapped(inside_out, [](const Vec3& p) { return Vec3(0.5 * p + Vec3(0.25, 0.5, 0.75)); }));
  CHECK(fixtures::identical(oriented(hollow, &done), hollow));
  CHECK(done.parts_left_inside == 1);
}

TEST_CASE("orient: a Moebius band is said to be one-sided") {
  geom::Orientation done;
  oriented(geom::make_shape("moebius"), &done);
  CHECK(done.one_sided == 1);
}
