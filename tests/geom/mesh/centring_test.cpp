// Moving far bodies near the origin, exactly.

#include "geom/mesh/centring.h"

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"

using geom::TriMesh;
using geom::Vec3;

TEST_CASE("centring: bodies near the origin stay") {
  const TriMesh mesh = geom::make_shape("torus");
  for (const double by : {0.0, 1.0, 5.0})
    CHECK(geom::far_middle(geom::moved_by(mesh, by * mesh.diagonal() * Vec3(1, -1, 0))) == Vec3(0, 0, 0));
  CHECK(geom::far_middle(TriMesh()) == Vec3(0, 0, 0));
}

TEST_CASE("centring: far bodies are moved on those axes, there and back without a rounding") {
  const TriMesh mesh = geom::make_shape("torus");
  for (const double by : {20.0, 1e3, 1e6, 1e12}) {
    CAPTURE(by);
    const TriMesh far = geom::moved_by(mesh, by * mesh.diagonal() * Vec3(1, 0, -1));
    const Vec3 middle = geom::far_middle(far);
    CHECK(middle.x() > 0);
    CHECK(middle.y() == 0);
    CHECK(middle.z() < 0);
    const TriMesh near = geom::moved_by(far, -middle);
    CHECK(near.box().max().cwiseAbs().maxCoeff() < 2 * mesh.diagonal());
    CHECK(geom::moved_by(near, middle).vertices() == far.vertices());
  }
}

TEST_CASE("centring: not where nothing representable would be left") {
  const TriMesh tiny = geom::mapped(geom::make_shape("torus"),
                                    [](const Vec3& p) { return Vec3(0x1p-890 * p + Vec3(0x1p-850, 0, 0)); });
  CHECK(geom::far_middle(tiny) == Vec3(0, 0, 0));
}
