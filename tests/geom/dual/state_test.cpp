#include "geom/dual/state.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "doctest.h"
#include "geom/check.h"
#include "geom/mesh/scaling.h"
#include "geom/rng.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/weighted_points.h"

using namespace geom;

TEST_CASE("dual state: a distance for a power is never too short, and hardly too long") {
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 1);
  DualState state(cube, CornerTypes::c_only, nullptr);
  Rng rng(1);
  for (int draw = 0; draw < 2000; ++draw) {
    const double weight = draw % 3 == 0 ? 0 : rng.uniform(-1, 1) * std::pow(10, rng.uniform(-12, 2));
    state.admit(SiteId(0), {Vec3(0.5, 0.5, 0), weight});
    const double distance = std::pow(10, rng.uniform(-8, 1));
    const double power = distance * distance - weight;
    const double bound = state.distance_at(power, SiteId(0));
    CHECK(bound >= distance);
    CHECK(bound * bound <= distance * distance * (1 + 1e-6) + 1e-8 * (std::abs(power) + std::abs(weight)));
  }
  state.admit(SiteId(0), {Vec3(0.5, 0.5, 0), 0.25});
  CHECK(state.distance_at(-1, SiteId(0)) == 0);
  CHECK(state.distance_at(-std::numeric_limits<double>::infinity(), SiteId(0)) == 0);
  CHECK(state.distance_at(std::numeric_limits<double>::infinity(), SiteId(0)) ==
        std::numeric_limits<double>::infinity());
}

// So that a site can come to it.
TEST_CASE("dual state: a circle's center is in the box of its facet, and snapped") {
  Rng rng(2);
  for (const auto& surface : fixtures::hard_surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    DualState state(mesh, CornerTypes::c_only, nullptr);
    state.admit(SiteId(0), {mesh.corner(FacetId(0), 0), 0.01});
    for (int draw = 0; draw < 100; ++draw) {
      EmptyCircle circle;
      circle.facet = FacetId(static_cast<std::size_t>(rng.below(mesh.num_facets())));
      circle.sites[0] = SiteId(0);
      const Vec3 corner =
          mesh.corner(circle.facet, static_cast<int>(rng.below(3))) + 1e-9 * fixtures::random_vector(rng);
      const CornerCircles::Place place = state.corners.place_of(corner, circle.facet, SiteId(0));
      Box3 box;
      for (int i = 0; i < 3; ++i) box.extend(mesh.corner(circle.facet, i));
      CHECK(box.contains(place.center));
      CHECK((place.center - corner).norm() <= 2e-9);
      CHECK(snapped(place.center) == place.center);
      CHECK(place.radius2 == power(place.center, state.sites[SiteId(0)]));
    }
  }
}

TEST_CASE("dual state: sites that are not regular are listed; a site outside of the mesh's box is a bug") {
  using Shape = geom::CellShape;
  const TriMesh cube = fixtures::box(Vec3(1, 1, 1), 1);
  DualState state(cube, CornerTypes::c_only, nullptr);
  const auto listed = [&] {
    std::vector<SiteId> list(state.shapes.not_regular().begin(), state.shapes.not_regular().end());
    std::ranges::sort(list);
    return list;
  };
  for (std::size_t i = 0; i < 5; ++i) {
    state.admit(SiteId(i), {Vec3(0.1, 0.2, 0), 0});
    state.search.enter(SiteId(i));
  }
  for (std::size_t i = 0; i < 5; ++i) CHECK(state.shapes[SiteId(i)] == Shape::regular);
  CHECK(listed().empty());
  state.set_shape(SiteId(2), Shape::irregular);
  state.set_shape(SiteId(2), Shape::irregular);
  state.set_shape(SiteId(4), Shape::unknown);
  CHECK(state.shapes[SiteId(2)] == Shape::irregular);
  CHECK(state.shapes[SiteId(4)] == Shape::unknown);
  CHECK(listed() == std::vector{SiteId(2), SiteId(4)});
  state.set_shape(SiteId(4), Shape::irregular);
  CHECK(listed() == std::vector{SiteId(2), SiteId(4)});
  state.set_shape(SiteId(2), Shape::regular);
  state.set_shape(SiteId(3), Shape::regular);
  CHECK(listed() == std::vector{SiteId(4)});
  CHECK_THROWS_AS(state.admit(SiteId(0), {Vec3(0.5, 1.1, 0.5), 0}), Bug);
}

TEST_CASE("dual state: a mesh without facets is bad input") {
  const TriMesh nothing;
  CHECK_THROWS_AS(DualState(nothing, CornerTypes::c_only, nullptr), InputError);
  CHECK_THROWS_AS(DualState(nothing, CornerTypes::all, nullptr), InputError);
}
