#include "fpo/plane/rectangle.h"

#include <cmath>

#include "doctest.h"
#include "fpo/remesh/pipeline.h"
#include "geom/check.h"

using geom::Vec2;

TEST_CASE("rectangle: a flat disk of the right size, all facing up, with its border exact") {
  for (const Vec2& size : {Vec2(1, 1), Vec2(0.3, 7), Vec2(1e6, 1e5)}) {
    for (const int cells : {1, 2, 13}) {
      const geom::TriMesh mesh = fpo::rectangle_mesh(size, cells);
      CHECK(mesh.area() == doctest::Approx(size.prod()));
      const geom::Topology t = geom::topology(mesh);
      CHECK(t.manifold());
      CHECK(t.euler == 1);
      CHECK(t.boundary_loops == 1);
      CHECK(t.misoriented_edges == 0);
      CHECK(mesh.box().min() == geom::Vec3(0, 0, 0));
      CHECK(mesh.box().max() == geom::Vec3(size.x(), size.y(), 0));
      for (std::size_t f = 0; f < mesh.num_facets(); ++f) CHECK(mesh.normal(geom::FacetId(f)).z() > 0);
    }
  }
  CHECK_THROWS_AS(fpo::rectangle_mesh({0, 1}), geom::InputError);
  CHECK_THROWS_AS(fpo::rectangle_mesh({1, NAN}), geom::InputError);
  CHECK_THROWS_AS(fpo::rectangle_mesh({1, 1}, 0), geom::InputError);
}

TEST_CASE("rectangle: with farthest points on the border no hole is left there") {
  // When all corners of the diagram are candidates the set is maximal: no location, the border's included, is
  // farther from the samples than delta.
  fpo::RemeshOptions options;
  options.num_samples = 150;
  options.surface.corners = geom::CornerTypes::all;
  options.optimize.max_iterations = 40;
  const Vec2 size(1.5, 1);
  const fpo::RemeshResult result = fpo::remesh(fpo::rectangle_mesh(size), options);
  const double least =
      result.optimization.last.delta * fpo::hexagonal_spacing(size.prod(), options.num_samples);
  constexpr int m = 150;
  for (int i = 0; i <= m; ++i) {
    for (int j = 0; j <= m; ++j) {
      const Vec2 x(size.x() * i / m, size.y() * j / m);
      double nearest = INFINITY;
      for (const fpo::SurfaceSample& s : result.samples)
        nearest = std::min(nearest, (s.position.head<2>() - x).norm());
      CHECK(nearest <= least * 1.02);
    }
  }
  CHECK(geom::topology(result.mesh).euler == 1);
  CHECK(result.mesh.num_vertices() == 150);
}
