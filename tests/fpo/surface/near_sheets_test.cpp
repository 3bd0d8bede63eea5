#include "fpo/surface/near_sheets.h"

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "fpo/remesh/remesh_defaults.h"
#include "fpo/surface/initial_samples.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

double share(const TriMesh& mesh, std::size_t n, double near) {
  const Sizing sizing = Sizing::uniform(hexagonal_spacing(mesh.area(), n));
  return share_on_near_sheets(mesh, sizing, random_samples(mesh, n, 1), near);
}

RemeshResult remeshed(const TriMesh& mesh, std::size_t n) {
  return remesh(mesh, default_options(n, SizingKind::uniform));
}

}  // namespace

TEST_CASE("near sheets: none of a sphere, nearly all of a thin plate, and fewer the farther apart they are") {
  CHECK(share(geom::make_shape("sphere", 16), 500, 1.1) == 0);
  CHECK(share_on_near_sheets(geom::make_shape("sphere", 8), Sizing::uniform(1), {}, 1.1) == 0);
  double before = 1;
  for (const double thickness : {0.01, 0.04, 0.06, 0.2}) {
    CAPTURE(thickness);
    const TriMesh plate = fixtures::box(Vec3(1, 1, thickness), 8);  // .07 between samples
    const double found = share(plate, 500, 1.1);
    CHECK(found < before);
    before = found;
    if (thickness == 0.01) CHECK(found > 0.9);
    if (thickness == 0.2) CHECK(found == 0);
  }
  const TriMesh plate = fixtures::box(Vec3(1, 1, 0.05), 8);
  CHECK(share(plate, 500, 0.7) < share(plate, 500, 1.1));
}

TEST_CASE("near sheets: where they are most of a surface they are set apart at once, where few are, not") {
  const RemeshResult shell = remeshed(geom::make_shape("shell", 12), 300);
  CHECK(shell.has_levels);
  CHECK(shell.type.ok());
  CHECK(shell.measures.theta_min > 33);
  CHECK(!remeshed(geom::make_shape("sphere", 12), 300).has_levels);
  CHECK(!remeshed(geom::make_shape("two-spheres", 12), 400).has_levels);
}

TEST_CASE("near sheets: of a thin plate two creases of each pair are given up, and all angles are good") {
  const RemeshResult result = remeshed(geom::make_shape("thin-plate"), 300);
  CHECK(result.type.ok());
  CHECK(result.measures.theta_min >= 30);
  CHECK(result.crease_curves == 4);
  CHECK(!result.given_up.empty());
}
