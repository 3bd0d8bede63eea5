#include "fpo/surface/sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "doctest.h"
#include "fpo/surface/initial_samples.h"
#include "geom/check.h"
#include "geom/rng.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::FacetId;
using geom::TriMesh;
using geom::VertexId;

namespace {

constexpr double sizing_infinity = std::numeric_limits<double>::infinity();

VertexField random_field(const TriMesh& mesh, double ratio, geom::Rng& rng) {
  VertexField rho;
  for (std::size_t v = 0; v < mesh.num_vertices(); ++v) rho.push_back(std::pow(ratio, rng.uniform()));
  return rho;
}

template <class Visit>
void visit_edges(const TriMesh& mesh, Visit visit) {
  for (const TriMesh::Facet& f : mesh.facets())
    for (std::size_t e = 0; e < 3; ++e)
      visit(f[e], f[(e + 1) % 3], (mesh.position(f[e]) - mesh.position(f[(e + 1) % 3])).norm());
}

}  // namespace

TEST_CASE("sizing: a fitted one calls for n samples and keeps the gradation and the limits") {
  geom::Rng rng(1);
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const double ratio : {1.0, 3.0, 50.0, 1e6})
      for (const std::size_t n : {20, 3000}) {
        CAPTURE(surface.name);
        CAPTURE(ratio);
        const TriMesh& mesh = surface.mesh;
        SizingLimits limits;
        limits.gradation = 0.2;
        const Sizing h = fit_sizing(mesh, random_field(mesh, ratio, rng), n, limits);
        CHECK(num_samples(mesh, h) == doctest::Approx(static_cast<double>(n)).epsilon(1e-4));
        const double even = hexagonal_spacing(mesh.area(), n);
        for (std::size_t v = 0; v < mesh.num_vertices(); ++v) {
          CHECK(h.at(VertexId(v)) >= limits.smallest * even * (1 - 1e-12));
          CHECK(h.at(VertexId(v)) <= limits.largest * even * (1 + 1e-12));
        }
        visit_edges(mesh, [&](VertexId a, VertexId b, double length) {
          CHECK(std::abs(h.at(a) - h.at(b)) <= limits.gradation * length * (1 + 1e-9));
        });
      }
}

TEST_CASE("sizing: within loose limits it is proportional to rho; the limit lowers, never raises") {
  const TriMesh mesh = fixtures::blob(6);
  VertexField rho;
  for (const geom::Vec3& p : mesh.vertices()) rho.push_back(2 + p.x());
  SizingLimits loose;
  loose.gradation = 10;
  const Sizing h = fit_sizing(mesh, rho, 500, loose);
  const double s = h.at(VertexId(0)) / rho[VertexId(0)];
  for (std::size_t v = 0; v < rho.size(); ++v)
    CHECK(h.at(VertexId(v)) == doctest::Approx(s * rho[VertexId(v)]).epsilon(1e-12));
  // Twice the field is the same wish.
  for (double& r : rho) r *= 2;
  CHECK(fit_sizing(mesh, rho, 500, loose).at(VertexId(3)) ==
        doctest::Approx(h.at(VertexId(3))).epsilon(1e-6));
}

TEST_CASE("sizing: the number of samples is the integral of 2 / (sqrt(3) h^2)") {
  const TriMesh mesh = fixtures::tilted_square(2);
  geom::Rng rng(5);
  VertexField field = random_field(mesh, 20, rng);
  for (double& length : field) length /= 50;
  const Sizing h(mesh, field);
  double sum = 0;
  constexpr int k = 400;  // midpoint rule on k^2 parts of each facet
  for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1))
    for (int i = 0; i < k; ++i)
      for (int j = 0; i + j < k; ++j)
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          if (third > 0.5 && i + j + 1 == k) continue;
          const double length = h.at(location_in_facet(mesh, t, (i + third) / k, (j + third) / k));
          sum += mesh.area(t) / (k * k) * 2 / std::sqrt(3.0) / (length * length);
        }
  CHECK(num_samples(mesh, h) == doctest::Approx(sum).epsilon(3e-3));
  for (const SizedPatch& patch : sized_patches(mesh, h)) {
    double least = sizing_infinity, most = 0;
    for (const geom::Vec2& at : patch.corners) {
      const double length = h.at(location_in_facet(mesh, patch.facet, at.x(), at.y()));
      least = std::min(least, length), most = std::max(most, length);
    }
    if (patch.num_samples > 0x1p-10) CHECK(most <= 1.2 * least * (1 + 1e-9));
    CHECK(patch.least_h <= least * (1 + 1e-9));
  }
}

TEST_CASE("sizing: initial samples follow the density") {
  const TriMesh mesh = fixtures::tilted_square(3);
  VertexField rho;
  for (const geom::Vec3& p : mesh.vertices()) rho.push_back(0.2 + p.y());
  const Sizing h(mesh, rho);
  constexpr std::size_t n = 40000;
  const std::vector<SurfaceSample> samples = random_samples(mesh, h, n, 9);
  CHECK(samples.size() == n);
  std::vector<double> wanted(mesh.num_facets(), 0), found(mesh.num_facets(), 0);
  double total = 0;
  for (const SizedPatch& patch : sized_patches(mesh, h)) {
    wanted[patch.facet.index()] += patch.num_samples;
    total += patch.num_samples;
  }
  for (const SurfaceSample& s : samples) found[s.facet.index()] += 1;
  double chi2 = 0;
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    const double expected = n * wanted[t] / total;
    chi2 += (found[t] - expected) * (found[t] - expected) / expected;
  }
  CHECK(chi2 < 45);  // 17 degrees of freedom: exceeded with probability 2e-4
}

TEST_CASE("sizing: what makes no sense is refused; no wish at all is uniform") {
  const TriMesh mesh = fixtures::blob(3);
  VertexField rho(mesh.num_vertices(), 1.0);
  for (const double bad : {std::nan(""), 0.0, -1.0}) {
    rho[VertexId(7)] = bad;
    CHECK_THROWS_WITH_AS(fit_sizing(mesh, rho, 100), doctest::Contains("vertex 8"), geom::InputError);
  }
  rho[VertexId(7)] = sizing_infinity;  // no wish there
  CHECK(num_samples(mesh, fit_sizing(mesh, rho, 100)) == doctest::Approx(100).epsilon(1e-4));
  CHECK_THROWS_AS(fit_sizing(mesh, VertexField(3, 1.0), 100), geom::InputError);
  CHECK_THROWS_AS(Sizing(mesh, VertexField(mesh.num_vertices(), sizing_infinity)), geom::InputError);
  CHECK_THROWS_AS(Sizing::uniform(0), geom::InputError);
  SizingLimits limits;
  limits.gradation = 0;
  CHECK_THROWS_AS(fit_sizing(mesh, rho, 100, limits), geom::InputError);
  CHECK(fit_sizing(mesh, VertexField(mesh.num_vertices(), sizing_infinity), 100).is_uniform());
}

TEST_CASE("sizing: lengths a million times apart take no more patches than samples call for") {
  const TriMesh mesh = fixtures::tilted_square(3);
  VertexField h(mesh.num_vertices(), 1.0);
  for (VertexId v(0); v.index() < h.size(); v = VertexId(v.value + 2)) h[v] = 1e-7;
  const Sizing sizing(mesh, h);
  const double many = num_samples(mesh, sizing, 1e5);
  CHECK(many > 1e5);
  CHECK(many < 1e6);  // it was left at once
  VertexField one(mesh.num_vertices(), 1.0);
  one[VertexId(5)] = 1e-7;
  const std::vector<SizedPatch> patches = sized_patches(mesh, Sizing(mesh, one));
  CHECK(patches.size() < 20000);
  double sum = 0;
  for (const SizedPatch& patch : patches) sum += patch.num_samples;
  CHECK(sum == doctest::Approx(num_samples(mesh, Sizing(mesh, one))));
  const std::vector<SurfaceSample> samples = random_samples(mesh, Sizing(mesh, one), 300, 3);
  CHECK(samples.size() == 300);
  const SizingLimits loose{.gradation = 10, .smallest = 1e-6, .largest = 10};
  CHECK(num_samples(mesh, fit_sizing(mesh, h, 300, loose)) == doctest::Approx(300).epsilon(1e-3));
}
