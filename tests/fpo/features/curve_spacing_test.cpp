#include "fpo/features/curve_spacing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "doctest.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/block.h"

using namespace fpo;
using fixtures::block;
using geom::TriMesh;
using geom::Vec3;

TEST_CASE("curve spacing: a thin side is a narrow place, a corner and a thin body without a wall are none") {
  const TriMesh cube = block(1, 1, 1);
  CHECK(narrow_places(cube, find_features(cube), 0.2).empty());
  const TriMesh slab = block(1, 1, 0.05);
  const std::vector<NarrowPlace> places = narrow_places(slab, find_features(slab), 0.2);
  CHECK(places.size() > 100);
  for (const NarrowPlace& place : places) {
    if (place.nearest) CHECK(place.width == doctest::Approx(0.05));
    CHECK(place.width > 0.0499);
    CHECK((place.at.z() == 0 || place.at.z() == 0.05));
  }
  // Not where shorter lengths are wanted, but where longer ones are.
  CHECK(nearest_places(slab, find_features(slab), 0.08).empty());
  CHECK(nearest_places(slab, find_features(slab), 0.08, 0.07).empty());
  CHECK(nearest_places(slab, find_features(slab), 0.08, 0.2).size() > 100);
  const auto number = [](const std::vector<NarrowPlace>& of) {
    return std::ranges::count(of, true, &NarrowPlace::nearest);
  };
  const auto nearest = nearest_places(slab, find_features(slab), 0.2);
  CHECK(number(nearest) == std::ssize(nearest));
  CHECK(number(nearest) == number(places));
  // Two squares above each other: their borders are near, but no surface is between.
  const TriMesh square = geom::make_shape("square");
  const TriMesh above = geom::mapped(square, [](const Vec3& p) -> Vec3 { return p + Vec3(0, 0, 0.05); });
  const TriMesh both = geom::joined(square, above);
  CHECK(narrow_places(both, find_features(both), 0.2).empty());
}

TEST_CASE(
    "curve spacing: where two bodies touch, and curves of one cross those of the other, no strip is "
    "between") {
  const TriMesh lower = block(1, 1, 0.7);
  for (const double turn : {0.0, 0.02, 0.5}) {
    CAPTURE(turn);
    const TriMesh upper = geom::mapped(block(1, 1, 0.7), [&](const Vec3& p) -> Vec3 {
      return {0.3 + p.x() * std::cos(turn) - p.y() * std::sin(turn),
              0.3 + p.x() * std::sin(turn) + p.y() * std::cos(turn), 0.7 + p.z()};
    });
    const TriMesh both = geom::joined(lower, upper);
    CHECK(narrow_places(both, find_features(both), 0.2).empty());
  }
}

TEST_CASE("curve spacing: a place is compared with the nearest curves only") {
  // Fins side by side: each place is within a spacing of the edges of all others.
  TriMesh fins = block(1, 0.001, 1);
  for (int i = 1; i < 40; ++i) {
    const double at = 0.004 * i;
    fins = geom::joined(
        fins, geom::mapped(block(1, 0.001, 1), [&](const Vec3& p) -> Vec3 { return p + Vec3(0, at, 0); }));
  }
  const std::vector<NarrowPlace> places = narrow_places(fins, find_features(fins), 0.5);
  REQUIRE(!places.empty());
  std::size_t of_one = 0, nearest = 0;
  for (const NarrowPlace& place : places) {
    of_one = place.nearest ? 1 : of_one + 1;
    nearest += place.nearest;
    REQUIRE(of_one <= 12);
    if (place.nearest) CHECK(place.width < 0.01);
  }
  CHECK(nearest > 100);
}

TEST_CASE("curve spacing: a thread is not cut to pieces as short as it is wide") {
  const TriMesh thread = block(1, 1e-9, 1e-9);
  const double spacing = std::sqrt(thread.area() / 300);
  CHECK(narrow_places(thread, find_features(thread), spacing).empty());
  CHECK(!narrow_surface(thread, find_features(thread), spacing, 0.18));
}

TEST_CASE("curve spacing: a wedge's curves are not narrow where they begin") {
  const TriMesh wedge = geom::make_shape("wedge");
  CHECK(narrow_places(wedge, find_features(wedge), 0.05).empty());
}

TEST_CASE(
    "curve spacing: exactly n samples, lengths that know the width, gradation kept, others hardly longer") {
  const TriMesh plate = geom::make_shape("hole-plate");
  constexpr std::size_t n = 3000;
  const double even = hexagonal_spacing(plate.area(), n), gradation = 0.25;
  const auto narrow = narrow_surface(plate, find_features(plate), even, gradation);
  REQUIRE(narrow.has_value());
  const TriMesh& surface = narrow->split.mesh;
  CHECK(surface.area() == doctest::Approx(plate.area()));
  CHECK(geom::topology(surface).euler == -22);
  CHECK(narrow->split.parents.size() == surface.num_facets());
  const CurveFit fit = fit_sizing_to_curves(plate, Sizing::uniform(even), *narrow, n);
  REQUIRE(fit.helped);
  CHECK(num_samples(surface, fit.sizing) == doctest::Approx(n).epsilon(1e-3));
  double least = 1e300;
  for (const NarrowPlace& place : narrow->places) least = std::min(least, place.width);
  CHECK(least == doctest::Approx(0.05).epsilon(0.1));
  double smallest = 1e300, largest = 0;
  for (std::size_t v = 0; v < surface.num_vertices(); ++v) {
    smallest = std::min(smallest, fit.sizing.at(geom::VertexId(v)));
    largest = std::max(largest, fit.sizing.at(geom::VertexId(v)));
  }
  CHECK(smallest < 0.8 * even);
  CHECK(smallest >= 1.4 * least);
  CHECK(largest <= 1.35 * even * (1 + 1e-12));
  for (const TriMesh::Facet& f : surface.facets())
    for (std::size_t e = 0; e < 3; ++e) {
      const geom::VertexId a = f[e], b = f[(e + 1) % 3];
      CHECK(std::abs(fit.sizing.at(a) - fit.sizing.at(b)) <=
            gradation * (surface.position(a) - surface.position(b)).norm() + 1e-9);
    }
}

TEST_CASE("curve spacing: fewer facets for lengths that are possible, and nearly the same lengths") {
  const TriMesh plate = geom::make_shape("hole-plate");
  constexpr std::size_t n = 1000;
  const double even = hexagonal_spacing(plate.area(), n), gradation = 0.25;
  auto narrow = narrow_surface(plate, find_features(plate), even, gradation);
  REQUIRE(narrow.has_value());
  const std::size_t before = narrow->split.mesh.num_facets();
  const CurveFit fit = fit_sizing_to_curves(plate, Sizing::uniform(even), *narrow, n);
  REQUIRE(fit.helped);
  CHECK(fit.least >= 0.1 * even * (1 - 1e-9));
  split_less(*narrow, plate, even, fit.least);
  const TriMesh& surface = narrow->split.mesh;
  CHECK(surface.num_facets() <= before);
  CHECK(surface.area() == doctest::Approx(plate.area()));
  CHECK(geom::topology(surface).euler == -22);
  REQUIRE(narrow->split.parents.size() == surface.num_facets());
  CHECK(narrow->lengths.size() == surface.num_vertices());
  CHECK(narrow->distances.size() == surface.num_vertices());
  const CurveFit again = fit_sizing_to_curves(plate, Sizing::uniform(even), *narrow, n);
  REQUIRE(again.helped);
  CHECK(again.least >= fit.least / 1.25);
  CHECK(again.least <= fit.least * 1.25);
  CHECK(num_samples(surface, again.sizing) == doctest::Approx(n).epsilon(1e-3));
}

TEST_CASE("curve spacing: long facets beside a narrow place become few parts") {
  const TriMesh bar = block(10, 1, 0.05);  // two facets a side
  const double spacing = 0.05 / 0.55;
  const auto narrow = narrow_surface(bar, find_features(bar), spacing, 0.25);
  REQUIRE(narrow.has_value());
  const TriMesh& surface = narrow->split.mesh;
  CHECK(surface.area() == doctest::Approx(bar.area()));
  CHECK(geom::topology(surface).euler == 2);
  const double per_sample = static_cast<double>(surface.num_facets()) * spacing * spacing / bar.area();
  CHECK(per_sample < 4);  // cut to parts like themselves they would be fourteen
}

TEST_CASE("curve spacing: what cannot be helped is left alone") {
  const TriMesh plate = geom::make_shape("thin-plate");
  const double even = hexagonal_spacing(plate.area(), 300);
  const auto narrow = narrow_surface(plate, find_features(plate), even, 0.25);
  REQUIRE(narrow.has_value());
  CHECK(!fit_sizing_to_curves(plate, Sizing::uniform(even), *narrow, 300).helped);
}
