// Parts that lie a little beside another one.

#include "geom/repair/copies.h"

#include "doctest.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/spoilt.h"

namespace {

using namespace fixtures;

constexpr double distance = 1e-3;

/// How many parts are dropped; the first mesh should be what is left.
std::size_t dropped(const TriMesh& first, const TriMesh& second, bool first_stays = true) {
  MeshArrays both = fixtures::arrays_of(geom::joined(first, second));
  const std::size_t count = geom::drop_copies(both.vertices, both.facets, distance);
  const std::size_t expected = count == 0    ? first.num_facets() + second.num_facets()
                               : first_stays ? first.num_facets()
                                             : second.num_facets();
  CHECK(both.facets.size() == expected);
  return count;
}

TriMesh moved(const TriMesh& mesh, const Vec3& by) {
  return geom::mapped(mesh, [&](const Vec3& p) { return Vec3(p + by); });
}

TriMesh turned_over(const TriMesh& mesh) {
  Rng rng(1);
  return fixtures::with_flips(mesh, 2, rng);
}

}  // namespace

TEST_CASE("copies: of two bodies on one another the larger stays, or the first") {
  Rng rng(3);
  for (const char* name : {"sphere", "torus", "l-block"}) {
    CAPTURE(name);
    const TriMesh mesh = geom::make_shape(name);
    CHECK(dropped(mesh, mesh) == 1);
    CHECK(dropped(mesh, moved(mesh, Vec3(5e-4, -5e-4, 0))) == 1);
    CHECK(dropped(mesh, moved(mesh, Vec3(0, 2e-3, 0))) == 0);
    const TriMesh larger = geom::mapped(mesh, [](const Vec3& p) { return Vec3(p * (1 + 1e-5)); });
    CHECK(dropped(mesh, larger, false) == 1);
    CHECK(dropped(larger, mesh) == 1);
  }
}

TEST_CASE("copies: another triangulation of the same surface is one, and so is a piece of it") {
  const TriMesh sphere = geom::make_shape("sphere", 40), other = geom::tilted(geom::make_shape("sphere", 37));
  CHECK(dropped(sphere, other, sphere.area() >= other.area()) == 1);
  MeshArrays piece = fixtures::arrays_of(sphere);
  piece.facets.resize(100);
  CHECK(dropped(sphere, moved(piece.take(), Vec3(0, 0, 5e-4))) == 1);
}

TEST_CASE("copies: the two sides of a wall and bodies that touch are none") {
  const TriMesh sphere = geom::make_shape("sphere");
  const TriMesh inside = geom::mapped(sphere, [](const Vec3& p) { return Vec3(p * (1 - 5e-4)); });
  CHECK(dropped(sphere, turned_over(inside)) == 0);
  CHECK(dropped(sphere, inside) == 1);
  CHECK(dropped(sphere, moved(sphere, Vec3(2, 0, 0))) == 0);
  MeshArrays one = fixtures::arrays_of(sphere);
  CHECK(geom::drop_copies(one.vertices, one.facets, distance) == 0);
}
