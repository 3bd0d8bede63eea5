#include "geom/mesh/scaling.h"

#include <cmath>
#include <limits>

#include "doctest.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using namespace geom;

namespace {

TriMesh one_facet(double size) {
  return TriMesh({Vec3(0, 0, 0), Vec3(size, 0, 0), Vec3(0, -size / 4, 0)},
                 {{VertexId(0), VertexId(1), VertexId(2)}});
}

}  // namespace

TEST_CASE("scaling: snapped is the nearest multiple, of numbers of all sizes and signs") {
  Rng rng(5);
  constexpr double unit = coordinate_unit;
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(300)) - 290);
    const double s = snapped(x, unit), units = s / unit;  // exact: division by a power of two
    CHECK(units == std::nearbyint(units));
    CHECK(std::abs(s - x) <= unit / 2);
    CHECK(snapped(s, unit) == s);
    CHECK(snapped(-x, unit) == -s);
    if (std::abs(x) >= 0x1p-108) CHECK(s == x);
  }
  for (const double tiny : {0.0, -0.0, 5e-324, -1e-300, unit / 2}) CHECK(!std::signbit(snapped(tiny, unit)));
  CHECK(snapped(0.75 * unit, unit) == unit);
  CHECK(snapped(1.5 * unit, unit) == 2 * unit);
  CHECK(snapped(-2.5 * unit, unit) == -2 * unit);
  CHECK(snapped(1e300, unit) == 1e300);
}

TEST_CASE("scaling: the factor brings the largest coordinate into [1/2, 1) and is undone exactly") {
  for (const double size : {1.0, 0.3, 8.0, 1e48, 1e-200, 1.3e-271, 0x1.fffffffffffffp5}) {
    const TriMesh mesh = one_facet(size);
    const double factor = factor_to_unit_box(mesh);
    int exponent = 0;
    CHECK(std::frexp(factor, &exponent) == 0.5);  // a power of two
    CHECK(size * factor >= 0.5);
    CHECK(size * factor < 1);
    const TriMesh unit = scaled_to_unit_box(mesh, factor);
    CHECK(scaled(unit, 1 / factor).vertices() == mesh.vertices());
    CHECK(factor_to_unit_box(mesh, one_facet(size / 16)) == factor);
    CHECK(factor_to_unit_box(one_facet(size / 16), mesh) == factor);
  }
  CHECK(factor_to_unit_box(TriMesh()) == 1);
  CHECK(factor_to_unit_box(one_facet(0)) == 1);
}

TEST_CASE("scaling: what cannot be scaled back exactly is refused") {
  for (const double size : {1e-272, 1e-310, 5e-324, 1e271, std::numeric_limits<double>::max()})
    CHECK_THROWS_AS(factor_to_unit_box(one_facet(size)), InputError);
}
