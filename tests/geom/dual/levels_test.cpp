// The restricted dual of a surface with levels, held against brute force and a rebuild.

#include "geom/mesh/levels.h"

#include "doctest.h"
#include "geom/dual/restricted_dual.h"
#include "geom/shapes/shapes.h"
#include "tests/fixtures/hard_surfaces.h"
#include "tests/fixtures/levels.h"
#include "tests/fixtures/mirrored_dual.h"

using namespace geom;
using fixtures::check_by_brute_force;
using fixtures::DualWalk;
using fixtures::Levels;
using fixtures::Weights;

TEST_CASE("levels: the dual equals brute force after every insertion, removal and move") {
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const Levels kind : fixtures::all_levels)
      for (const Weights weights : {Weights::none, Weights::gentle})
        for (const CornerTypes types : {CornerTypes::c_only, CornerTypes::all}) {
          CAPTURE(surface.name);
          CAPTURE(static_cast<int>(kind));
          CAPTURE(static_cast<int>(weights));
          CAPTURE(static_cast<int>(types));
          const TriMesh mesh = fixtures::with_levels(surface.mesh, kind, 0.2 * surface.mesh.diagonal());
          DualWalk walk(mesh, {.weights = weights, .types = types});
          for (int step = 0; step < (mesh.num_facets() > 100 ? 6 : 24); ++step) {
            CAPTURE(step);
            walk.step();
            check_by_brute_force(walk.d);
          }
        }
}

// The fast way is taken where all is on one level, the general way elsewhere, and where they meet both.
TEST_CASE("levels: after each of many moves the dual is that of a rebuild, on both ways") {
  const fixtures::NamedSurface surfaces[] = {{"torus", fixtures::torus(1, 0.4, {24, 14, true, true, 0.2})},
                                             {"sphere", make_shape("sphere", 5)},
                                             {"thin plate", fixtures::box(Vec3(1, 0.8, 0.01), 8)}};
  std::size_t fast = 0, in_place = 0, general = 0;
  for (const auto& surface : surfaces)
    for (const Weights weights : {Weights::none, Weights::gentle}) {
      CAPTURE(surface.name);
      CAPTURE(static_cast<int>(weights));
      const TriMesh mesh = fixtures::with_levels(surface.mesh, Levels::ramp, 0.3);
      DualWalk walk(mesh, {.num_sites = 90, .weights = weights, .keeps_number = true, .seed = 8});
      walk.build();
      walk.spread(1);
      for (int step = 0; step < 50; ++step) {
        CAPTURE(step);
        walk.step();
        fixtures::MirroredDual fresh(mesh, true, CornerTypes::c_only);
        std::vector<fixtures::Placed> samples;
        for (const SiteId p : walk.d.present()) samples.push_back(walk.d.placed(p));
        fresh.build(samples, 1 + step % 3);
        REQUIRE(walk.d.known_circles() == fresh.known_circles());
        for (const SiteId p : walk.d.present()) {
          REQUIRE(walk.d.dual().has_cell(p) == fresh.dual().has_cell(p));
          if (!fresh.dual().has_cell(p)) continue;
          const double reach = fresh.dual().reach(p);
          REQUIRE(walk.d.dual().reach_bound(p) >= reach - 1e-8 * std::abs(reach));
        }
      }
      check_by_brute_force(walk.d);
      const DualWays& ways = walk.d.dual().ways();
      fast += ways.fast_removals + ways.fast_insertions;
      in_place += ways.in_place;
      general += ways.general_insertions;
    }
  CHECK(fast > 150);
  CHECK(in_place > 5);
  CHECK(general > 50);
}

TEST_CASE("levels: sheets that are far apart on them have the diagrams that they have alone") {
  const TriMesh one = fixtures::torus(1, 0.4, {16, 10, true, true, 0.2});
  Table<VertexId, Vec3> vertices = one.vertices();
  Table<FacetId, TriMesh::Facet> facets = one.facets();
  Table<VertexId, double> levels(one.num_vertices(), 0.0);
  for (const Vec3& q : one.vertices()) {
    vertices.push_back(q + Vec3(0, 0, 0.001));
    levels.push_back(5);
  }
  const int shift = static_cast<int>(one.num_vertices());
  for (const TriMesh::Facet& f : one.facets())
    facets.push_back({VertexId(std::size_t(f[0].value + shift)), VertexId(std::size_t(f[1].value + shift)),
                      VertexId(std::size_t(f[2].value + shift))});
  const TriMesh both = TriMesh(std::move(vertices), std::move(facets)).with_levels(std::move(levels));
  const std::vector<fixtures::Placed> samples = fixtures::placed_samples(both, 200, 200, Weights::none, 3);
  std::vector<fixtures::Placed> lower;
  for (const fixtures::Placed& x : samples)
    if (x.home.index() < one.num_facets()) lower.push_back(x);
  std::vector<fixtures::Placed> in_order = lower;  // first those of the lower sheet
  for (const fixtures::Placed& x : samples)
    if (x.home.index() >= one.num_facets()) in_order.push_back(x);
  fixtures::MirroredDual apart(both, true, CornerTypes::c_only), alone(one, true, CornerTypes::c_only);
  apart.build(in_order);
  alone.build(lower);
  std::vector<oracle::KnownCircle> circles;
  for (const oracle::KnownCircle& c : apart.known_circles())
    if (c.name.facet.index() < one.num_facets()) circles.push_back(c);
  CHECK(circles == alone.known_circles());
}
