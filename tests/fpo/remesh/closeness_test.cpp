#include "fpo/remesh/closeness.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "doctest.h"
#include "fpo/measure/hausdorff.h"
#include "fpo/optimize.h"
#include "fpo/remesh/extract.h"
#include "fpo/remesh/flaws.h"
#include "fpo/remesh/sample_journal.h"
#include "fpo/remesh/spreading.h"
#include "fpo/remesh/surface_above.h"
#include "fpo/surface/initial_samples.h"
#include "geom/rng.h"
#include "geom/shapes/mesh_parts.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/surfaces.h"

using namespace fpo;
using geom::TriMesh;
using geom::Vec3;

namespace {

/// With sharp edges between the samples.
TriMesh folded() {
  return geom::mapped(fixtures::box(Vec3(2, 1, 1), 6), [](const Vec3& p) -> Vec3 {
    return {p.x(), p.y(), p.z() + 0.2 * std::abs(p.x() - 1)};
  });
}

SurfaceDomain optimized(const TriMesh& mesh, std::size_t n, int iterations) {
  SurfaceDomain domain(mesh, random_samples(mesh, n, 5));
  for (std::size_t i = 0; i < static_cast<std::size_t>(iterations) * n; ++i)
    domain.move(SiteId(i % n), Scope::global);
  return domain;
}

std::vector<SurfaceSample> samples_in(const SurfaceDomain& domain) {
  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < domain.num_samples(); ++i) samples.push_back(domain.sample(SiteId(i)));
  return samples;
}

/// The remesh's triangles.
TriMesh dual_mesh(const SurfaceDomain& domain) {
  geom::Table<geom::VertexId, Vec3> vertices;
  for (const SurfaceSample& x : samples_in(domain)) vertices.push_back(x.position);
  geom::Table<geom::FacetId, TriMesh::Facet> facets;
  for_triangles(domain.dual(), [&](const geom::EmptyCircle& circle) {
    TriMesh::Facet facet;
    for (std::size_t i = 0; i < 3; ++i) facet[i] = geom::VertexId(circle.sites[i].index());
    facets.push_back(facet);
  });
  return TriMesh(std::move(vertices), std::move(facets));
}

}  // namespace

TEST_CASE("surface above: the largest distance of the surface from triangles is found on one of them") {
  for (const TriMesh& mesh : {folded(), fixtures::blob(10)}) {
    const SurfaceDomain domain = optimized(mesh, 150, 6);
    const TriMesh dual = dual_mesh(domain);
    const geom::AabbTree tree(dual);
    SurfaceAbove above(domain.mesh());
    double found = 0;
    for_triangles(domain.dual(), [&](const geom::EmptyCircle& circle) {
      std::array<SurfaceSample, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = domain.sample(circle.sites[i]);
      const auto all = [&](std::vector<geom::DistanceFromTriangle>& others) {
        for (std::size_t t = 0; t < dual.num_facets(); ++t)
          others.emplace_back(tree.triangle(geom::FacetId(t)));
      };
      const FarPoint far = above.farthest(corners, {0}, all);
      found = std::max(found, far.distance);
      if (far.distance > 0)
        CHECK(std::sqrt(tree.closest(far.at.position).distance2) == doctest::Approx(far.distance));
      std::vector<geom::DistanceFromTriangle> star;
      for (const SiteId s : circle.sites)
        for (const CircleId c : domain.dual().circles_of(s))
          if (const auto& t = domain.dual().circle(c).sites; t[2].valid() && t != circle.sites)
            star.emplace_back(std::array{domain.sample(t[0]).position, domain.sample(t[1]).position,
                                         domain.sample(t[2]).position});
      REQUIRE(star.size() <= 64);
      for (const double enough : {0.0, 0.5 * far.distance, far.distance}) {
        const auto beside = [&](auto& others) { others.insert(others.end(), star.begin(), star.end()); };
        const double forwards = above.farthest(corners, {enough}, beside).distance;
        std::ranges::reverse(star);
        CHECK(above.farthest(corners, {enough}, beside).distance == forwards);
        CHECK((forwards == 0 || forwards > (1 - 1e-9) * enough));
        for (const double share : {0.3, 0.9, 1.1}) {
          const double most = share * far.distance;
          const double any = above.farthest(corners, {enough, most}, beside).distance;
          CHECK((any > most) == (forwards > most));
          if (!(any > most)) CHECK(any == forwards);
        }
      }
    });
    double expected = 0;  // at the middles and ends of edges
    for (std::size_t t = 0; t < mesh.num_facets(); ++t)
      for (int e = 0; e < 3; ++e)
        for (const double s : {0.0, 0.25, 0.5, 0.75}) {
          const Vec3 x = (1 - s) * domain.mesh().corner(geom::FacetId(t), e) +
                         s * domain.mesh().corner(geom::FacetId(t), (e + 1) % 3);
          expected = std::max(expected, std::sqrt(tree.closest(x).distance2));
        }
    CHECK(found > 0.95 * expected);
  }
}

TEST_CASE(
    "surface above: a margin after the angles between triangles loses nothing of the largest distance") {
  for (const TriMesh& mesh : {folded(), fixtures::blob(10), fixtures::box({1, 1, 0.02}, 8)}) {
    const SurfaceDomain domain = optimized(mesh, 150, 6);
    const auto normal_of = [&](const geom::EmptyCircle& circle) -> Vec3 {
      const auto at = [&](std::size_t i) -> Vec3 { return domain.sample(circle.sites[i]).position; };
      return (circle.clockwise ? -1 : 1) * (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    };
    SurfaceAbove above(domain.mesh());
    double wide = 0, fit = 0;
    for_triangles(domain.dual(), [&](const geom::EmptyCircle& circle) {
      std::array<SurfaceSample, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = domain.sample(circle.sites[i]);
      std::vector<geom::DistanceFromTriangle> star;
      double least = 1;
      for (const SiteId s : circle.sites)
        for (const CircleId c : domain.dual().circles_of(s)) {
          const geom::EmptyCircle& other = domain.dual().circle(c);
          const auto& t = other.sites;
          least = std::min(least, normal_of(circle).dot(normal_of(other)));
          if (t != circle.sites)
            star.emplace_back(std::array{domain.sample(t[0]).position, domain.sample(t[1]).position,
                                         domain.sample(t[2]).position});
        }
      const auto beside = [&](auto& others) { others.insert(others.end(), star.begin(), star.end()); };
      const double own = above.farthest(corners, {0}, beside, Prism::margin_beside(least)).distance;
      wide = std::max(wide, above.farthest(corners, {0}, beside).distance);
      fit = std::max(fit, own);
    });
    CHECK(fit == doctest::Approx(wide).epsilon(0.01));
  }
}

TEST_CASE("closeness: the surface beyond the border of the triangles counts") {
  const TriMesh mesh = fixtures::tilted_square(4);
  int nearer = 0;
  for (std::size_t n = 80; n <= 120; n += 10) {
    CAPTURE(n);
    SurfaceDomain domain = optimized(mesh, n, 20);
    const double before = surface_distance(dual_mesh(domain), mesh).max;
    ClosenessOptions options;
    options.enough_delta = 0.8;
    come_closer(domain, {}, options);
    nearer += surface_distance(dual_mesh(domain), mesh).max < 0.8 * before;
  }
  CHECK(nearer >= 3);
}

TEST_CASE("closeness: mostly the surfaces are nearer, never farther; samples as many and not too close") {
  const TriMesh mesh = folded();
  int nearer = 0;
  for (std::size_t n = 60; n < 140; n += 10) {
    CAPTURE(n);
    SurfaceDomain domain = optimized(mesh, n, 20);
    const AngleOptions angles;
    ClosenessOptions options;
    options.enough_delta = 0.8;
    const double delta = std::min(measure(domain).delta, options.enough_delta);
    const double bad = Flaws(domain, bad_angles(domain, angles)).penalty();
    const double distance = surface_distance(dual_mesh(domain), domain.mesh()).max;
    const std::vector<SurfaceSample> before = samples_in(domain);
    const ClosenessResult result = come_closer(domain, angles, options);
    CHECK(result.tried > 0);
    CHECK(domain.num_samples() == n);
    CHECK(measure(domain).delta >= delta * (1 - 1e-9));
    CHECK(Flaws(domain, bad_angles(domain, angles)).penalty() <= bad + 1e-6);
    domain.check();
    if (result.mended == 0) {  // all is as it was
      CHECK(result.largest_after == result.largest_before);
      for (std::size_t i = 0; i < n; ++i) CHECK(domain.sample(SiteId(i)).position == before[i].position);
      continue;
    }
    ++nearer;
    CHECK(result.largest_after < result.largest_before);
    CHECK(surface_distance(dual_mesh(domain), domain.mesh()).max < distance);
  }
  CHECK(nearer >= 4);
}

TEST_CASE("closeness: threads change nothing, and the largest distance is that of all triangles") {
  const TriMesh mesh = fixtures::blob(12);
  constexpr std::size_t n = 1200;  // more triangles than two ranges have
  ClosenessOptions options;
  options.rounds = 1;
  options.most_moves = 200;
  std::vector<SurfaceSample> by_one;
  ClosenessResult of_one;
  for (const int threads : {1, 2, 8}) {
    SurfaceDomain domain = optimized(mesh, n, 3);
    const double largest = surface_distance(dual_mesh(domain), domain.mesh()).max;
    options.threads = threads;
    const ClosenessResult result = come_closer(domain, {}, options);
    CHECK(result.largest_before == doctest::Approx(largest).epsilon(0.02));
    if (threads == 1) {
      by_one = samples_in(domain);
      of_one = result;
    }
    CHECK(result.tried > 0);
    CHECK(result.largest_before == of_one.largest_before);
    CHECK(result.largest_after == of_one.largest_after);
    for (std::size_t i = 0; i < n; ++i) CHECK(domain.sample(SiteId(i)).position == by_one[i].position);
  }
}

TEST_CASE("closeness: a largest distance that is one of many is left alone, and looks can be few") {
  const TriMesh mesh = geom::make_shape("sphere", 12);
  SurfaceDomain domain = optimized(mesh, 100, 20);
  ClosenessOptions options;
  options.enough_delta = 0.5;
  options.most_far = 0;
  CHECK(come_closer(domain, {}, options).tried == 0);
  options.most_far = 1;
  options.most_looks = 0;
  CHECK(come_closer(domain, {}, options).tried == 0);
  options.most_looks = ClosenessOptions().most_looks;
  CHECK(come_closer(domain, {}, options).tried > 0);
}

TEST_CASE("closeness: where too many are far less is asked for") {
  const TriMesh mesh = fixtures::blob(12);
  const SurfaceDomain samples = optimized(mesh, 300, 20);
  ClosenessOptions options;
  options.enough_delta = 0.8;
  options.most_far = 0.01;
  ClosenessResult results[2];
  for (const int rounds : {1, 8}) {
    SurfaceDomain domain = samples.rebuilt();
    options.rounds = rounds;
    results[rounds > 1] = come_closer(domain, {}, options);
  }
  CHECK(results[0].tried == 0);
  CHECK(results[1].mended > 0);
  CHECK(results[1].largest_after < results[1].largest_before);
}

TEST_CASE("closeness: interrupted, or without moves to spare, little is done") {
  const TriMesh mesh = folded();
  SurfaceDomain domain = optimized(mesh, 100, 5);
  const std::vector<SurfaceSample> before = samples_in(domain);
  std::atomic<bool> stop = true;
  ClosenessOptions options;
  options.interrupted = &stop;
  CHECK(come_closer(domain, {}, options).tried == 0);
  options.interrupted = nullptr;
  options.most_moves = 0;
  CHECK(come_closer(domain, {}, options).tried <= 1);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    moved += samples_in(domain)[i].position != before[i].position;
  CHECK(moved < before.size() / 2);
}

TEST_CASE("sample journal: all is as it was, however samples were moved") {
  const TriMesh mesh = fixtures::blob(6);
  SurfaceDomain domain = optimized(mesh, 80, 2);
  const std::vector<SurfaceSample> before = samples_in(domain);
  SampleJournal journal(domain);
  geom::Rng rng(8);
  for (int i = 0; i < 300; ++i) {
    const SiteId x(static_cast<std::size_t>(rng.below(80)));
    journal.note(x);
    domain.move(x, Scope::global);
  }
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    moved += domain.sample(SiteId(i)).position != before[i].position;
  CHECK(moved > 40);
  journal.undo();
  domain.check();
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(domain.sample(SiteId(i)).position == before[i].position);
    CHECK(domain.sample(SiteId(i)).facet == before[i].facet);
  }
}

TEST_CASE("spreading: a sample put too near another makes room, or nothing comes nearer") {
  const TriMesh mesh = fixtures::blob(8);
  SurfaceDomain domain = optimized(mesh, 150, 20);
  const geom::AabbTree tree(domain.mesh());
  const double delta = measure(domain).delta;
  Spreading spreading(domain, {}, tree, {0.9 * delta, 0.5 * delta});
  CHECK(spreading.penalty() == 0);
  std::size_t done = 0;
  for (const std::size_t i : {3u, 40u, 77u, 120u}) {
    SampleJournal journal(domain);
    spreading.keep(&journal);
    const SiteId x(i);
    journal.note(x);
    const SurfaceSample home = domain.sample(x);
    std::vector<SiteId> link;
    domain.dual().link(x, link);
    const Vec3 towards = domain.sample(link.front()).position - home.position;
    const geom::AabbTree::Closest closest = tree.closest(home.position + 0.25 * towards);
    domain.remove(x);
    domain.insert_at(x, {geom::snapped(closest.point), closest.facet}, 1);
    CHECK(spreading.penalty() > 0);
    if (spreading.spread()) {
      ++done;
      CHECK(measure(domain).delta >= 0.9 * delta * (1 - 1e-9));
    }
    journal.undo();
    CHECK(spreading.penalty() < 1e-12);
  }
  CHECK(done > 0);
}
