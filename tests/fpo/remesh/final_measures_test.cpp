#include "fpo/remesh/final_measures.h"

#include <cmath>

#include "doctest.h"
#include "fpo/measure/quality.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

TEST_CASE("final measures: of a regular triangle and of a flat one") {
  const TriMesh regular({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, std::sqrt(0.75), 0)},
                        {{VertexId(0), VertexId(1), VertexId(2)}});
  const FinalMeasures good = final_measures(regular, VertexField(3, 2.0), 0, {});
  CHECK(good.delta == doctest::Approx(0.5));
  CHECK(good.mean_delta == doctest::Approx(0.5));
  CHECK(good.mean_edge == doctest::Approx(0.5));
  CHECK(good.least_edge == doctest::Approx(0.5));
  CHECK(good.theta_min == doctest::Approx(60));
  CHECK(good.angles_below_30 == 0);
  CHECK(good.bad_triangles == 0);

  const TriMesh flat({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0.1, 0)},
                     {{VertexId(0), VertexId(1), VertexId(2)}});
  const FinalMeasures bad = final_measures(flat, VertexField{1.0, 4.0, 1.0}, 0, {});
  const double side = std::hypot(1, 0.1);
  CHECK(bad.delta == doctest::Approx(side / 4));
  CHECK(bad.least_edge == doctest::Approx(side / 2));
  CHECK(bad.least.length == doctest::Approx(side));
  CHECK((bad.least.middle - Vec3(1.5, 0.05, 0)).norm() < 1e-15);
  CHECK(!bad.least.is_fixed);
  const FinalMeasures other = final_measures(flat, VertexField{0.1, 1.0, 4.0}, 1, {});
  CHECK((other.least.middle - Vec3(1.5, 0.05, 0)).norm() < 1e-15);
  CHECK(other.shortest.length == doctest::Approx(side));
  CHECK(final_measures(flat, VertexField{1.0, 1.0, 4.0}, 3, {}).least.is_fixed);
  CHECK(bad.mean_edge == doctest::Approx((2 / 2.0 + side / 2 + side) / 3));
  CHECK(bad.angles_below_30 == 2);
  CHECK(bad.theta_min == doctest::Approx(std::atan(0.1) * 180 / std::acos(-1.0)));
  CHECK(bad.bad_triangles == 1);
  CHECK(final_measures(flat, VertexField{1.0, 4.0, 1.0}, 2, {}).delta ==
        doctest::Approx(side));  // two are fixed
}

TEST_CASE("final measures: with even lengths delta is that of quality, and of the domain") {
  const TriMesh mesh = fixtures::blob(6);
  const SurfaceDomain domain(mesh, random_samples(mesh, 300, 2));
  const Dual dual = dual_of(domain, geom::surface_type(mesh), false);
  const double h = hexagonal_spacing(mesh.area(), 300);
  const FinalMeasures measures = final_measures(dual.mesh, VertexField(300, h), 0, {});
  const Quality q = quality(dual.mesh, mesh.area());
  CHECK(measures.delta == doctest::Approx(q.delta));
  CHECK(measures.mean_delta == doctest::Approx(q.delta_avg));
  CHECK(measures.mean_edge == doctest::Approx(q.edge_avg));
  CHECK(measures.theta_min == doctest::Approx(q.theta_min));
}

TEST_CASE("type advice: places and a number where the type is wrong, nothing where it is right") {
  const TriMesh mesh = geom::make_shape("dumbbell", 12);
  const geom::SurfaceType type = geom::surface_type(mesh);
  const auto advice_with = [&](std::size_t n) {
    const SurfaceDomain domain(mesh, random_samples(mesh, n, 1));
    const Dual dual = dual_of(domain, type, false);
    const TypeAdvice advice = type_advice(dual, mesh, type, domain.sizing());
    CHECK(dual.type.ok() == advice.places.empty());
    CHECK(dual.type.ok() == (advice.samples == 0));
    return advice;
  };
  const TypeAdvice few = advice_with(60);
  REQUIRE(!few.places.empty());
  CHECK(few.samples > 60);
  bool at_bar = false;
  for (const Vec3& x : few.places) at_bar |= std::abs(x.z()) < 1.2;
  CHECK(at_bar);
}

TEST_CASE("type advice: where all is thin the number grows with the square") {
  const TriMesh mesh = geom::make_shape("dumbbell", 12);
  const geom::SurfaceType type = geom::surface_type(mesh);
  const SurfaceDomain domain(mesh, random_samples(mesh, 60, 1));
  Dual dual = dual_of(domain, type, false);
  REQUIRE(!dual.type.ok());
  dual.cell_faults.clear();
  dual.defects = {{geom::SiteId(0), {}}};  // each asks for twice as many
  CHECK(type_advice(dual, mesh, type, domain.sizing()).samples == 120);
  for (std::size_t i = 0; i < 60; i += 2) dual.defects.push_back({geom::SiteId(i), {}});
  CHECK(type_advice(dual, mesh, type, domain.sizing()).samples == 240);
}
