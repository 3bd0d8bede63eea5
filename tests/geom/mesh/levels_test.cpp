// Levels of locations, and the corner tests in four coordinates against exact corners.

#include "geom/mesh/levels.h"

#include <algorithm>
#include <array>

#include "doctest.h"
#include "geom/power/clip_predicates.h"
#include "geom/power/construct.h"
#include "tests/fixtures/levels.h"
#include "tests/fixtures/surfaces.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/predicates_oracle.h"

using namespace geom;
using fixtures::Hardship;
using oracle::ExactSite;

namespace {

constexpr int draws = 400;  // of each hardship

/// A facet and four sites, all of one hardship, with levels drawn likewise.
struct Scene {
  std::vector<WeightedPoint3> points;
  std::array<double, 3> levels;
  std::array<RankedPoint3, 4> site;
  std::array<ExactSite, 4> exact, perturbed;

  Scene(Hardship hardship, Rng& rng) : points(draw(hardship, 7, false, rng)) {
    const std::vector<WeightedPoint3> others = draw(hardship, 7, false, rng);
    oracle::Scale scale;
    for (std::size_t i = 0; i < 7; ++i) {
      points[i].level = rng.below(3) == 0 ? points[0].level : others[i].position.x();
      scale.cover(points[i]);
    }
    std::array<int, 4> rank{0, 1, 2, 3};
    rng.shuffle(std::span<int>(rank));
    for (std::size_t i = 0; i < 3; ++i) levels[i] = points[4 + i].level;
    for (std::size_t i = 0; i < 4; ++i) {
      site[i] = {&points[i], rank[i]};
      exact[i] = oracle::exact_site(points[i]);
      perturbed[i] = lifted(exact[i], scale.epsilon(rank[i]));
    }
  }
  Scene(const Scene&) = delete;
  FacetCorners facet() const {
    return {&points[4].position, &points[5].position, &points[6].position, levels};
  }
};

template <class Sign>
bool expected(const Scene& scene, Sign sign) {
  const int known = sign(scene.exact);
  return (known != 0 ? known : sign(scene.perturbed)) < 0;
}

template <class Test>
void for_each_scene(Test test) {
  Rng rng(3);
  for (const Hardship hardship : fixtures::all_hardships) {
    INFO("hardship: " << fixtures::name_of(hardship));
    for (int i = 0; i < draws; ++i) test(Scene(hardship, rng));
  }
}

}  // namespace

TEST_CASE("levels: the corner tests are the comparison of exact powers in four coordinates") {
  int edges = 0, facets = 0;
  for_each_scene([&](const Scene& s) {
    const FacetCorners q = s.facet();
    CHECK(beats_at_vertex(q.at(0), s.site[0], s.site[3]) ==
          expected(s, [&](const auto& x) { return compare_powers(oracle::at(q.at(0)), x[0], x[3]); }));
    const auto side = [&](std::size_t i) {
      return compare_powers(oracle::at(q.at(i)), s.perturbed[0], s.perturbed[1]);
    };
    if (side(0) * side(1) < 0) {
      ++edges;
      CHECK(beats_on_edge(q.at(0), q.at(1), s.site[0], s.site[1], s.site[2]) ==
            expected(s, [&](const auto& x) {
              return compare_powers(on_edge(q.at(0), q.at(1), x[0], x[1]), x[0], x[2]);
            }));
    }
    if (in_facet(q, s.exact[0], s.exact[1], s.exact[2]).w.sign() == 0) return;
    ++facets;
    CHECK(beats_in_facet(q, s.site[0], s.site[1], s.site[2], s.site[3]) == expected(s, [&](const auto& x) {
            return compare_powers(in_facet(q, x[0], x[1], x[2]), x[0], x[3]);
          }));
  });
  CHECK(edges > draws);
  CHECK(facets > draws);
}

TEST_CASE("levels: a rounded bisector is as near to the exact one as it says") {
  for_each_scene([&](const Scene& s) {
    double extent = 0;
    for (const WeightedPoint3& p : s.points)
      extent = std::max({extent, p.position.lpNorm<Eigen::Infinity>(), std::abs(p.level)});
    const Bisector b = bisector(s.points[0], s.points[1], extent);
    for (std::size_t i = 0; i < 3; ++i) {
      const Location3 q = s.facet().at(i);
      const double f = b(q);
      if (std::abs(f) > b.error)
        CHECK((f < 0) == (compare_powers(oracle::at(q), s.exact[0], s.exact[1]) < 0));
    }
  });
}

TEST_CASE("levels of locations are between those of the corners, and as near as they say") {
  Rng rng(5);
  for (const fixtures::NamedSurface& surface : fixtures::surfaces())
    for (const fixtures::Levels kind : fixtures::all_levels) {
      const TriMesh mesh = fixtures::with_levels(surface.mesh, kind, 0.3);
      const FacetLevels levels(mesh);
      for (FacetId t(0); t.index() < mesh.num_facets(); t = FacetId(t.value + 1)) {
        const auto [a, b, c] = mesh.facet(t);
        CHECK(levels.is_flat(t) == (mesh.level(a) == mesh.level(b) && mesh.level(b) == mesh.level(c)));
        for (int i = 0; i < 5; ++i) {
          const double u = rng.uniform(), v = (1 - u) * rng.uniform();
          const Vec3 x = (1 - u - v) * mesh.corner(t, 0) + u * mesh.corner(t, 1) + v * mesh.corner(t, 2);
          const double exact = (1 - u - v) * mesh.level(a) + u * mesh.level(b) + v * mesh.level(c);
          const double off = rng.below(2) == 0 ? 0 : 1e-3;
          const Vec3 near = x + Vec3::Constant(off);
          CHECK(std::abs(levels.at(t, near) - exact) <= levels.off(t, off) + 1e-12);
          CHECK(levels.gap(t, levels.at(t, near)) == 0);
          CHECK(std::abs(levels.at(t, near) - levels.middle(t)) <= levels.half(t) + 1e-15);
        }
      }
    }
}
