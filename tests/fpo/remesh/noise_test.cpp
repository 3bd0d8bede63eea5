// Noise finer than the spacing.

#include "fpo/remesh/noise.h"

#include "doctest.h"
#include "fpo/remesh/remesh_defaults.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/mesh/surface_type.h"
#include "geom/rng.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"
#include "tests/io/sample_meshes.h"

using geom::TriMesh;
using geom::Vec3;

namespace {

TriMesh noisy(const TriMesh& mesh, double by) {
  geom::Rng rng(5);
  const double most = by * mesh.diagonal();
  return geom::mapped(mesh, [&](const Vec3& p) -> Vec3 {
    return p + most * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  });
}

}  // namespace

TEST_CASE("noise: smooth surfaces have none, nor do coarse ones") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    CHECK(!fpo::has_noise(mesh, mesh.num_facets() / 6 + 1));
  }
  const TriMesh sphere = geom::make_shape("sphere", 60);
  CHECK(!fpo::has_noise(sphere, 20));
  CHECK(fpo::has_noise(noisy(sphere, 0.01), 20));
  CHECK(!fpo::has_noise(noisy(sphere, 1e-5), 20));
  CHECK(!fpo::has_noise(noisy(sphere, 0.01), sphere.num_facets()));
  CHECK(fpo::is_folded(noisy(sphere, 0.01)));  // coarse or not
  CHECK(!fpo::is_folded(sphere));
}

TEST_CASE("noise: without it facets and borders are the same, and the surface is near the one before") {
  const TriMesh square = geom::make_shape("square", 60), rough = noisy(square, 0.012);
  const TriMesh smooth = fpo::smoothed(rough, 100);
  CHECK(smooth.facets() == rough.facets());
  CHECK(!fpo::has_noise(smooth, 100));
  CHECK(rough.area() > 1.2 * smooth.area());
  CHECK(smooth.area() == doctest::Approx(square.area()).epsilon(0.1));
  const geom::AabbTree tree(square);
  for (const Vec3& p : smooth.vertices()) CHECK(tree.closest(p).distance2 < 4e-4 * square.area());
}

TEST_CASE(
    "noise: the remesh is of the surface's type, on the surface, with good angles, and the same again") {
  for (const char* name : {"torus", "square"}) {
    CAPTURE(name);
    const TriMesh rough = noisy(geom::make_shape(name, 70), 0.012);
    fpo::RemeshOptions options = fpo::default_options(150, fpo::SizingKind::uniform);
    options.optimize.max_iterations = 8;
    REQUIRE(fpo::has_noise(rough, options.num_samples));
    const fpo::RemeshResult result = fpo::remesh(rough, options);
    CHECK(result.stood_in);
    CHECK(result.mesh.num_vertices() == 150);
    const geom::Topology before = geom::topology(rough), after = geom::topology(result.mesh);
    CHECK(after.manifold());
    CHECK(after.vertices == 150);
    CHECK(after.euler == before.euler);
    CHECK(after.boundary_loops == before.boundary_loops);
    CHECK(result.type.ok());
    CHECK(result.measures.theta_min > 20);
    for (const fpo::SurfaceSample& x : result.samples)
      CHECK(geom::closest_point(
                x.position, {rough.corner(x.facet, 0), rough.corner(x.facet, 1), rough.corner(x.facet, 2)})
                .distance2 < 1e-20 * rough.area());
    if (std::string(name) != "torus") continue;
    options.keep_cells = true;  // the same again, with the cells of its samples
    const fpo::RemeshResult with_cells = fpo::remesh(rough, options);
    CHECK(fixtures::identical(with_cells.mesh, result.mesh));
    double area = 0;
    for (const fpo::CellPolygon& cell : with_cells.cells)
      for (std::size_t i = 2; i < cell.corners.size(); ++i)
        area += 0.5 * (cell.corners[i - 1] - cell.corners[0]).cross(cell.corners[i] - cell.corners[0]).norm();
    CHECK(area == doctest::Approx(rough.area()));
  }
}
