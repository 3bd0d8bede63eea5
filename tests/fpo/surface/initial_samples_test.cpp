#include "fpo/surface/initial_samples.h"

#include <cmath>

#include "doctest.h"
#include "geom/check.h"
#include "geom/mesh/aabb_tree.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using fpo::random_samples;
using fpo::Sizing;
using fpo::SurfaceSample;
using geom::FacetId;
using geom::TriMesh;
using geom::Vec3;
using geom::VertexId;

namespace {

/// How far counts are from their expectations, in standard deviations of the chi-square of so many cells.
double chi_square_deviation(const std::vector<double>& counts, const std::vector<double>& expected) {
  double chi2 = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    chi2 += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const double freedom = static_cast<double>(counts.size()) - 1;
  return (chi2 - freedom) / std::sqrt(2 * freedom);
}

/// Distance of a sample from its own facet.
double off_facet(const TriMesh& mesh, const SurfaceSample& x) {
  const std::array q{mesh.corner(x.facet, 0), mesh.corner(x.facet, 1), mesh.corner(x.facet, 2)};
  return std::sqrt(geom::closest_point(x.position, q).distance2);
}

}  // namespace

TEST_CASE("initial samples: exactly n, each on its facet, inside the surface's box, the same again") {
  for (const auto& surface : fixtures::surfaces()) {
    CAPTURE(surface.name);
    const TriMesh& mesh = surface.mesh;
    for (const std::size_t n : {1, 2, 997}) {
      const auto samples = random_samples(mesh, n, 7), again = random_samples(mesh, n, 7),
                 others = random_samples(mesh, n, 8);
      REQUIRE(samples.size() == n);
      double off = 0;
      for (std::size_t i = 0; i < n; ++i) {
        REQUIRE(samples[i].facet.index() < mesh.num_facets());
        off = std::max(off, off_facet(mesh, samples[i]));
        CHECK(mesh.box().contains(samples[i].position));
        CHECK(samples[i].position == again[i].position);
        CHECK(samples[i].facet == again[i].facet);
      }
      CHECK(off < 1e-15 * mesh.diagonal());
      CHECK(samples[0].position != others[0].position);
    }
  }
}

TEST_CASE("initial samples: each facet has its share, and each quarter of a facet its own") {
  const TriMesh mesh = geom::make_shape("frame", 1);
  constexpr std::size_t n = 60'000;
  std::vector<double> counts(4 * mesh.num_facets(), 0), expected(4 * mesh.num_facets());
  for (std::size_t i = 0; i < expected.size(); ++i)
    expected[i] = static_cast<double>(n) * mesh.area(FacetId(i / 4)) / mesh.area() / 4;
  for (const SurfaceSample& x : random_samples(mesh, n, 11)) {
    const std::array q{mesh.corner(x.facet, 0), mesh.corner(x.facet, 1), mesh.corner(x.facet, 2)};
    const auto b = geom::closest_point(x.position, q).barycentric;
    const std::size_t quarter = b[0] > .5 ? 0 : b[1] > .5 ? 1 : b[2] > .5 ? 2 : 3;
    ++counts[4 * x.facet.index() + quarter];
  }
  CHECK(std::abs(chi_square_deviation(counts, expected)) < 4);
}

TEST_CASE("initial samples: density falls with the square of the wanted length") {
  const TriMesh square = geom::make_shape("square", 8);
  fpo::VertexField h;
  for (const Vec3& p : square.vertices()) h.push_back(0.5 + 2 * (p.x() - square.box().min().x()));
  const Sizing sizing(square, h);
  constexpr std::size_t n = 20'000, strips = 16;
  // The integral of h^-2 up to x, as h = 0.5 + 2 x: (1/0.5 - 1/h) / 2.
  const double x0 = square.box().min().x(), width = square.box().diagonal().x();
  const auto mass = [&](double x) { return (2 - 1 / (0.5 + 2 * x)) / 2; };
  std::vector<double> counts(strips, 0), expected;
  for (std::size_t i = 0; i < strips; ++i)
    expected.push_back(static_cast<double>(n) *
                       (mass(width * double(i + 1) / strips) - mass(width * double(i) / strips)) /
                       mass(width));
  for (const SurfaceSample& x : random_samples(square, sizing, n, 3)) {
    const double at = (x.position.x() - x0) / width * strips;
    ++counts[std::min(static_cast<std::size_t>(at), strips - 1)];
  }
  // The patches carry a mean density that is off by up to 1%, hence more than chance.
  CHECK(std::abs(chi_square_deviation(counts, expected)) < 8);
}

TEST_CASE("initial samples: facets without area get none; no area or no number is refused") {
  const TriMesh mesh({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(2, 0, 0)},
                     {{VertexId(0), VertexId(1), VertexId(3)},
                      {VertexId(0), VertexId(1), VertexId(2)},
                      {VertexId(1), VertexId(0), VertexId(3)}});
  for (const SurfaceSample& x : random_samples(mesh, 500, 1)) CHECK(x.facet == FacetId(1));
  const TriMesh line({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)},
                     {{VertexId(0), VertexId(1), VertexId(2)}});
  CHECK_THROWS_AS(random_samples(line, 5, 1), geom::InputError);
  CHECK_THROWS_AS(random_samples(mesh, 0, 1), geom::InputError);
  CHECK_THROWS_AS(random_samples(mesh, 1'000'000'000, 1), geom::InputError);
}
