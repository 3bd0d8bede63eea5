#include "fpo/remesh/angles.h"

#include <cmath>

#include "doctest.h"
#include "fpo/measure/quality.h"
#include "fpo/optimize.h"
#include "fpo/remesh/extract.h"
#include "geom/mesh/aabb_tree.h"
#include "tests/fixtures/sizings.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;

namespace {

/// Few iterations: some bad angles are left.
SurfaceDomain rough_samples(const TriMesh& mesh, const Sizing& sizing, std::size_t n) {
  SurfaceDomain domain(mesh, sizing, random_samples(mesh, sizing, n, 4));
  OptimizeOptions options;
  options.max_iterations = 1;
  options.scope = Scope::two_ring;
  optimize(domain, options);
  return domain;
}

std::size_t count_bad(const SurfaceDomain& domain, const AngleOptions& bounds) {
  const TriMesh mesh = extract(*domain.diagram(), domain.num_samples());
  std::size_t bad = 0;
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) {
    double least = 180, most = 0;
    for (int i = 0; i < 3; ++i) {
      const geom::Vec3 at = mesh.corner(geom::FacetId(t), i),
                       u = mesh.corner(geom::FacetId(t), (i + 1) % 3) - at,
                       v = mesh.corner(geom::FacetId(t), (i + 2) % 3) - at;
      const double angle = std::acos(u.dot(v) / (u.norm() * v.norm())) * 180 / std::acos(-1.0);
      least = std::min(least, angle), most = std::max(most, angle);
    }
    bad += least < bounds.smallest - 1e-7 || most > bounds.largest + 1e-7;
  }
  return bad;
}

VertexField sloping(const TriMesh& mesh) {
  VertexField rho;
  for (const geom::Vec3& p : mesh.vertices()) rho.push_back(1.6 + p.z());
  return rho;
}

}  // namespace

TEST_CASE("angles: bad triangles are counted as an independent count does, and get fewer") {
  const TriMesh mesh = fixtures::blob(8);
  for (const bool uniform : {true, false}) {
    CAPTURE(uniform);
    const Sizing sizing = uniform ? fixtures::even(mesh, 800) : fit_sizing(mesh, sloping(mesh), 800);
    SurfaceDomain domain = rough_samples(mesh, sizing, 800);
    const AngleOptions bounds;
    const std::size_t before = count_bad(domain, bounds);
    REQUIRE(before > 3);
    const double delta = measure(domain).delta;
    const AngleResult result = optimize_angles(domain, bounds);
    CHECK(result.bad_before == before);
    CHECK(result.bad_after == count_bad(domain, bounds));
    CHECK(4 * result.bad_after <= before);
    CHECK(result.mended <= result.tried);
    CHECK(domain.num_samples() == 800);
    CHECK(domain.num_hidden() == 0);
    domain.check();
    if (uniform) CHECK(measure(domain).delta >= delta);
    std::size_t reweighted = 0;
    for (std::size_t i = 0; i < 800; ++i) reweighted += domain.weight_share(geom::SiteId(i)) != 1;
    CHECK(reweighted == result.reweighted);
  }
}

TEST_CASE("angles: what cannot be mended is put back") {
  const TriMesh mesh = fixtures::blob(6);
  const Sizing sizing = fit_sizing(mesh, sloping(mesh), 300);
  SurfaceDomain domain = rough_samples(mesh, sizing, 300);
  // Nobody can have all angles above 50 degrees: much is tried, and the sum of squares must not grow.
  AngleOptions hard;
  hard.smallest = 50;
  hard.largest = 75;
  hard.max_moves = 0;  // twenty for every sample are left
  const auto penalty = [&] {
    const TriMesh remesh = extract(*domain.diagram(), 300);
    double sum = 0;
    for (std::size_t t = 0; t < remesh.num_facets(); ++t) {
      double least = 180, most = 0;
      for (int i = 0; i < 3; ++i) {
        const geom::Vec3 at = remesh.corner(geom::FacetId(t), i),
                         u = remesh.corner(geom::FacetId(t), (i + 1) % 3) - at,
                         v = remesh.corner(geom::FacetId(t), (i + 2) % 3) - at;
        const double angle = std::acos(u.dot(v) / (u.norm() * v.norm())) * 180 / std::acos(-1.0);
        least = std::min(least, angle), most = std::max(most, angle);
      }
      const double beyond = std::max(hard.smallest - least, 0.0) + std::max(most - hard.largest, 0.0);
      sum += beyond * beyond;
    }
    return sum;
  };
  const double before = penalty();
  const AngleResult result = optimize_angles(domain, hard);
  CHECK(result.tried > 30);
  CHECK(result.tried < 1000);
  CHECK(result.bad_after > 0);
  CHECK(penalty() <= before * (1 + 1e-9));
  domain.check();
}

TEST_CASE("angles: interrupted before the start, nothing changes") {
  const TriMesh mesh = fixtures::blob(5);
  const Sizing sizing = fixtures::even(mesh, 200);
  SurfaceDomain domain = rough_samples(mesh, sizing, 200);
  const auto before = domain.diagram()->canonical();
  std::atomic<bool> stop{true};
  AngleOptions options;
  options.interrupted = &stop;
  CHECK(optimize_angles(domain, options).tried == 0);
  CHECK(domain.diagram()->canonical() == before);
}

TEST_CASE("angles: small steps mend what resampling does not, and never lower delta") {
  const TriMesh mesh = fixtures::blob(8);
  const Sizing sizing = fixtures::even(mesh, 500);
  std::size_t steps = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SurfaceDomain domain(mesh, sizing, random_samples(mesh, sizing, 500, seed));
    OptimizeOptions options;
    options.max_iterations = 12;
    optimize(domain, options);
    std::vector<SurfaceSample> before;
    for (std::size_t i = 0; i < 500; ++i) before.push_back(domain.sample(SiteId(i)));
    const double delta = measure(domain).delta;
    AngleOptions strict;  // more than can be had
    strict.smallest = 38;
    strict.largest = 104;
    optimize_angles(domain, strict);
    CHECK(measure(domain).delta >= delta);
    const geom::AabbTree tree(mesh);
    for (std::size_t i = 0; i < 500; ++i) {
      const SurfaceSample& x = domain.sample(SiteId(i));
      const double way = (x.position - before[i].position).norm() / sizing.at(x);
      steps += way > 0 && way < 0.09;
      CHECK(tree.closest(x.position).distance2 < 1e-24);
    }
  }
  CHECK(steps > 0);
}
