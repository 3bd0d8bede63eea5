#include "fpo/remesh/cell_faults.h"

#include <algorithm>
#include <array>

#include "doctest.h"
#include "fpo/optimize.h"
#include "fpo/remesh/dual.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/pinched.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::SiteId;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// Samples where they are wanted.
SurfaceDomain domain_of(const TriMesh& mesh, const std::vector<Vec3>& near) {
  std::vector<SurfaceSample> samples;
  for (const Vec3& x : near) {
    SurfaceSample best{mesh.corner(geom::FacetId(0), 0), geom::FacetId(0)};
    for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
      const SurfaceSample here = location_in_facet(mesh, geom::FacetId(t), 0.31, 0.34);
      if ((here.position - x).norm() < (best.position - x).norm()) best = here;
    }
    samples.push_back(best);
  }
  return SurfaceDomain(mesh, samples);
}

/// Of the diagram whose orphans are given away.
std::vector<CellFault> faults_of(const SurfaceDomain& domain) {
  const std::unique_ptr<geom::RestrictedPower> diagram = domain.diagram();
  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) samples.push_back(domain.sample(SiteId(i)));
  const Localization localization = localize(*diagram, samples);
  return cell_faults(*diagram, localization.owners);
}

std::vector<Vec3> ring(int count, double height, double turn) {
  std::vector<Vec3> places;
  for (int i = 0; i < count; ++i) {
    const double angle = turn + 2 * std::acos(-1.0) * i / count;
    places.push_back({std::cos(angle), std::sin(angle), height});
  }
  return places;
}

std::vector<Vec3> operator+(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

TEST_CASE("cell faults: a long tube with one sample, two or three around") {
  const TriMesh tube =
      fixtures::weld(geom::make_shape("tube", 24).vertices(), geom::make_shape("tube", 24).facets());
  // Three rings of four at both ends, so that nothing is wrong there.
  const std::vector<Vec3> ends = ring(4, 0.95, 0) + ring(4, -0.95, 0.2);
  const std::vector<CellFault> one = faults_of(domain_of(tube, ends + ring(1, 0, 0.4)));
  CHECK(std::ranges::all_of(one, [](const CellFault& f) { return f.cell.valid(); }));
  CHECK(faults_of(domain_of(tube, ends + ring(4, 0.3, 0.4) + ring(4, -0.3, 0.9))).empty());

  // Alone between two rings far away, one sample owns all around; two own half each and meet in two arcs.
  const TriMesh handle = geom::make_shape("dumbbell", 12);  // its bar is .19 around, 1 long
  const auto with_bar = [&](std::vector<Vec3> bar) {
    std::vector<Vec3> places = std::move(bar);
    for (const double z : {-1.5, 1.5}) {
      for (const Vec3& x : ring(8, 0, 0) + ring(8, 0.6, 0.3) + ring(8, -0.6, 0.3))
        places.push_back(x.normalized() + Vec3(0, 0, z));
      places.push_back({0, 0, z + 1});
      places.push_back({0, 0, z - 1});
    }
    return faults_of(domain_of(handle, places));
  };
  const std::vector<CellFault> annulus = with_bar({{0.03, 0, 0}});
  const auto found = std::ranges::find(annulus, SiteId(0), &CellFault::cell);
  REQUIRE(found != annulus.end());
  CHECK(!found->other.valid());
  CHECK(found->girth == doctest::Approx(2 * std::acos(-1.0) * 0.03).epsilon(0.1));
  CHECK(!found->around.empty());
  const std::vector<CellFault> pair = with_bar({{0.03, 0, 0}, {-0.03, 0, 0}});
  const auto both = std::ranges::find_if(
      pair, [](const CellFault& f) { return f.cell == SiteId(0) && f.other == SiteId(1); });
  REQUIRE(both != pair.end());
  CHECK(!both->around.empty());
}

TEST_CASE("cell faults: none where the samples are dense, and then the dual is of the surface's type") {
  for (const char* name : {"torus", "sphere", "double-torus", "tube", "moebius"}) {
    CAPTURE(std::string(name));
    const TriMesh mesh = geom::make_shape(name, name == std::string("double-torus") ? 31 : 16);
    SurfaceDomain domain(mesh, random_samples(mesh, 300, 3));
    OptimizeOptions options;
    options.max_iterations = 5;
    optimize(domain, options);
    CHECK(faults_of(domain).empty());
    CHECK(dual_of(domain, geom::surface_type(mesh), false).type.ok());
  }
}

TEST_CASE("cell faults: wherever the type is wrong there is one, and none lets it be right") {
  for (const char* name : {"torus", "frame", "two-spheres", "dumbbell", "thin-handle", "horn"})
    for (const std::size_t n : {6u, 12u, 25u, 60u}) {
      CAPTURE(std::string(name));
      CAPTURE(n);
      const TriMesh mesh = geom::make_shape(name, 8);
      const SurfaceDomain domain(mesh, random_samples(mesh, n, 5));
      const Dual dual = dual_of(domain, geom::surface_type(mesh), false);
      if (dual.localization.remaining > 0 || dual.localization.merged > 0) continue;
      if (!dual.type.ok()) {
        CHECK(!dual.cell_faults.empty());
      } else {
        CHECK(dual.cell_faults.empty());
      }
    }
}

TEST_CASE(
    "cell faults: the same where the surface meets itself in a vertex, of which each sheet has its own") {
  const TriMesh mesh = fixtures::pinched_sphere();
  REQUIRE(geom::topology(mesh).nonmanifold_vertices == 1);
  const geom::SurfaceType type = geom::surface_type(mesh);
  std::array<int, 2> seen{};  // of the wrong type, of the right one
  for (const std::size_t n : {4u, 5u, 6u, 8u, 12u, 25u, 300u})
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      CAPTURE(n);
      CAPTURE(seed);
      const SurfaceDomain domain(mesh, random_samples(mesh, n, seed));
      const Dual dual = dual_of(domain, type, false);
      if (dual.localization.remaining > 0 || dual.localization.merged > 0) continue;
      CHECK(dual.type.ok() == faults_of(domain).empty());
      ++seen[dual.type.ok()];
    }
  CHECK(seen[0] > 0);
  CHECK(seen[1] > 10);
}
