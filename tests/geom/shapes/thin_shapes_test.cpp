#include "geom/shapes/thin_shapes.h"

#include <algorithm>
#include <string>

#include "doctest.h"
#include "geom/check.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/volume.h"

using fixtures::volume;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// The smallest and the largest distance from the z axis of vertices whose height is at most `height`.
std::pair<double, double> radii(const TriMesh& mesh, double height) {
  std::pair<double, double> result{1e9, 0};
  for (const Vec3& p : mesh.vertices()) {
    if (std::abs(p.z()) > height) continue;
    const double r = p.head<2>().norm();
    result = {std::min(result.first, r), std::max(result.second, r)};
  }
  return result;
}

}  // namespace

// Their topology is checked with that of all shapes, in shapes_test.

TEST_CASE("thin shapes: sheets are as thin as their rows say") {
  CHECK(volume(geom::make_shape("plate")) == doctest::Approx(1.0 / 40));
  CHECK(volume(geom::make_shape("paper")) == doctest::Approx(1.0 / 100));  // a shear keeps volumes
  CHECK(volume(geom::make_shape("comb")) == doctest::Approx(0.05 * (0.2 * 0.9 + 12 * 0.8 * 0.02)));
  CHECK(volume(geom::make_shape("boxes")) == doctest::Approx(1 + 0.75 * 0.875 * 0.75));
  const double ball = volume(geom::make_shape("sphere", 24));
  CHECK(volume(geom::make_shape("shell")) == doctest::Approx(ball * (1 - 0.92 * 0.92 * 0.92)));
}

TEST_CASE("thin shapes: necks and holes are as narrow as their rows say") {
  CHECK(radii(geom::make_shape("dumbbell"), 0.4).second == doctest::Approx(0.03));
  CHECK(radii(geom::make_shape("narrow-torus"), 1).first == doctest::Approx(0.03));
  double thickest = 0;
  const TriMesh handle = geom::make_shape("thin-handle"), tube = geom::make_shape("pinched-tube");
  for (const Vec3& p : handle.vertices())
    if (p.x() < 0 && std::abs(p.y()) < 0.1) thickest = std::max(thickest, std::abs(p.z()));
  CHECK(thickest == doctest::Approx(0.03));
  double pinched = 0;
  for (const Vec3& p : tube.vertices())
    if (std::abs(p.z()) < 0.05) pinched = std::max(pinched, std::abs(p.y()));
  CHECK(pinched < 0.025);
}

TEST_CASE("thin shapes: pin-holes are triangles that no vertex shares") {
  const TriMesh mesh = geom::make_shape("pin-holes");
  CHECK(geom::topology(mesh).boundary_edges == 15);
  CHECK(geom::topology(mesh).boundary_loops == 5);
  CHECK(geom::topology(mesh).manifold());
}
