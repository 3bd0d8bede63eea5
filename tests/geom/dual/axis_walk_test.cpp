// Walks to axes: where they end, against exact numbers; and where they must not.

#include "geom/dual/axis_walk.h"

#include <algorithm>

#include "doctest.h"
#include "geom/rng.h"
#include "tests/fixtures/dual_scene.h"
#include "tests/oracle/rational.h"

using namespace geom;
using fixtures::DualScene;
using fixtures::Placed;
using oracle::Rational;

namespace {

Rational exact_lead(const Vec3& z, const WeightedPoint3& owner, const WeightedPoint3& other) {
  Rational sum = Rational(owner.weight) - Rational(other.weight);
  for (int k = 0; k < 3; ++k) {
    const Rational there = Rational(z[k]) - Rational(other.position[k]),
                   here = Rational(z[k]) - Rational(owner.position[k]);
    sum = sum + there * there - here * here;
  }
  return sum;
}

/// Does the axis of the sites meet the inside of the facet, where they turn counterclockwise?
bool meets_exactly(const DualScene& scene, FacetId t, const std::array<SiteId, 3>& sites) {
  std::vector<Rational> f, g;
  for (int k = 0; k < 3; ++k) {
    const Vec3& q = scene.state.mesh.corner(t, k);
    f.push_back(exact_lead(q, scene.state.sites[sites[0]], scene.state.sites[sites[1]]));
    g.push_back(exact_lead(q, scene.state.sites[sites[0]], scene.state.sites[sites[2]]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if ((f[j] * g[k] - f[k] * g[j]).sign() <= 0) return false;
  }
  return true;
}

AxisPlace walk(const DualScene& scene, const std::array<SiteId, 3>& sites, FacetId start) {
  return walk_to_axis(scene.state.mesh, scene.state.clipper, sites, start);
}

std::array<SiteId, 3> counterclockwise(const EmptyCircle& circle) {
  return {circle.sites[0], circle.sites[circle.after(0)], circle.sites[circle.before(0)]};
}

}  // namespace

TEST_CASE("axis walk: from a circle's facet it finds the circle, in whatever order the sites are given") {
  std::size_t found = 0, circles = 0;
  fixtures::for_scenes(120, [&](const DualScene& scene, std::span<const Placed>) {
    for (const SiteId p : scene.present)
      for (const CircleId c : scene.state.circles.of_site(p)) {
        const EmptyCircle& circle = scene.state.circles[c];
        std::array<SiteId, 3> sites = counterclockwise(circle);
        ++circles;
        for (int turn = 0; turn < 3; ++turn) {
          std::rotate(sites.begin(), sites.begin() + 1, sites.end());
          const AxisPlace place = walk(scene, sites, circle.facet);
          if (place.facet != circle.facet) continue;
          ++found;
          const EmptyCircle same = scene.state.corners.circle_of(sites, place.facet, place.point.position);
          CHECK(same.center == circle.center);
          CHECK(same.radius2 == circle.radius2);
        }
      }
  });
  CHECK(found > 3 * circles * 99 / 100);
}

TEST_CASE("axis walk: wherever it ends, the axis meets the facet, and the sites turn counterclockwise") {
  std::size_t ended = 0, nowhere = 0;
  Rng rng(3);
  fixtures::for_scenes(60, [&](const DualScene& scene, std::span<const Placed>) {
    for (int draw = 0; draw < 150; ++draw) {
      const SiteId p = scene.present[rng.below(scene.present.size())];
      std::vector<SiteId> near = scene.link(p);
      if (near.size() < 2) continue;
      const SiteId a = near[rng.below(near.size())], b = rng.below(2) == 0
                                                             ? near[rng.below(near.size())]
                                                             : scene.present[rng.below(scene.present.size())];
      if (a == b || b == p) continue;
      const FacetId start(static_cast<std::size_t>(rng.below(scene.state.mesh.num_facets())));
      const AxisPlace place = walk(scene, {p, a, b}, start);
      ++(place.facet.valid() ? ended : nowhere);
      if (!place.facet.valid()) continue;
      CHECK(meets_exactly(scene, place.facet, {p, a, b}));
      CHECK(walk(scene, {p, b, a}, place.facet).facet != place.facet);  // clockwise
    }
  });
  CHECK(ended > 200);
  CHECK(nowhere > 200);
}

// The axis of these stands upright; it is moved over a square of two facets.
TEST_CASE("axis walk: on an edge of the surface, and beyond its border, nothing is certain") {
  const TriMesh square = fixtures::sheet(1, 1, [](double, double) { return 0.25; });
  const auto ends = [&](double x, double y) {
    std::vector<Placed> samples;
    for (const Vec3& d : {Vec3(0.25, 0, 0), Vec3(-0.125, 0.25, 0), Vec3(-0.125, -0.25, 0)}) {
      const Vec3 site = Vec3(x, y, 0.25) + d;
      samples.push_back({{site, d.squaredNorm()}, FacetId(0)});
    }
    Clipper::Sites sites;
    for (const Placed& s : samples) sites.push_back(s.point);
    const Clipper clipper(square, sites, 4);
    return walk_to_axis(square, clipper, {SiteId(0), SiteId(1), SiteId(2)}, FacetId(0)).facet.valid();
  };
  CHECK(ends(0.5, 0.25));
  CHECK(ends(0.25, 0.5));
  CHECK(!ends(0.5, 0.5));  // on the diagonal, or else on no diagonal but inside of a facet
  CHECK(!ends(0.5, 0));
  CHECK(!ends(1.25, 0.5));
}
