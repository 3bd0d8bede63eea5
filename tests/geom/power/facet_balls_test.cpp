#include "geom/power/facet_balls.h"

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using geom::FacetId;
using geom::Vec3;

TEST_CASE(
    "facet balls: no location of a facet is outside of its ball, nor where a ball is said not to come") {
  geom::Rng rng(4);
  int near = 0, far = 0;
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    const geom::FacetBalls balls(mesh, mesh.box().max().cwiseAbs().maxCoeff() + mesh.diagonal());
    for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
      double u = rng.uniform(), v = rng.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 q0 = mesh.corner(t, 0);
      const Vec3 at = q0 + u * (mesh.corner(t, 1) - q0) + v * (mesh.corner(t, 2) - q0);
      CHECK((at - balls.middle(t)).norm() <= balls.radius(t) * (1 + 1e-12));
      const Vec3 away(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
      const Vec3 x = mesh.box().center() + 0.4 * mesh.diagonal() * away;
      const double distance = 0.6 * mesh.diagonal() * rng.uniform();
      const bool comes = balls.comes_near(t, x, distance);
      (comes ? near : far) += 1;
      if (!comes) CHECK((at - x).norm() > distance);
    }
  }
  CHECK(near > 100);
  CHECK(far > 100);
}
