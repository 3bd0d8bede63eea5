// The corner tests of the restricted power diagram against exact corners, and their consistency.

#include "geom/power/clip_predicates.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "doctest.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/predicates_oracle.h"

using fixtures::Hardship;
using geom::FacetCorners;
using geom::RankedPoint3;
using geom::Rng;
using geom::Vec3;
using geom::WeightedPoint3;
using oracle::ExactSite;

namespace {

constexpr int draws = 1500;  // of each hardship

/// A facet and four sites, all of one hardship, with random ranks; exactly, and perturbed in fact.
struct Scene {
  std::vector<WeightedPoint3> corners, points;
  std::array<Vec3, 3> q;
  std::array<RankedPoint3, 4> site;
  std::array<ExactSite, 4> exact, perturbed;

  Scene(Hardship hardship, Rng& rng) : points(draw(hardship, 7, false, rng)) {
    corners.assign(points.begin() + 4, points.end());
    oracle::Scale scale;
    for (const WeightedPoint3& p : points) scale.cover(p);
    std::array<int, 4> rank{0, 1, 2, 3};
    rng.shuffle(std::span<int>(rank));
    for (std::size_t i = 0; i < 3; ++i) q[i] = corners[i].position;
    for (std::size_t i = 0; i < 4; ++i) {
      site[i] = {&points[i], 5 * rank[i] - 2};
      exact[i] = oracle::exact_site(points[i]);
      perturbed[i] = lifted(exact[i], scale.epsilon(rank[i]));
    }
  }
  Scene(const Scene&) = delete;
  FacetCorners facet() const { return {&q[0], &q[1], &q[2]}; }

  /// Does the perturbed bisector of sites i and j cut edge q0 q1?
  bool cuts_edge(std::size_t i, std::size_t j) const {
    return compare_powers(oracle::at(q[0]), perturbed[i], perturbed[j]) *
               compare_powers(oracle::at(q[1]), perturbed[i], perturbed[j]) <
           0;
  }
  /// Do the bisectors of site 0 with 1 and with 2 cross in the facet's plane?
  bool has_corner() const { return in_facet(facet(), exact[0], exact[1], exact[2]).w.sign() != 0; }
};

struct ClipPredicatesCount {
  int asked = 0, ties = 0;
};

/// `sign` of the oracle without perturbation, or, on a tie, with it.
template <class Sign>
bool expect(Sign sign, const Scene& scene, ClipPredicatesCount& count) {
  ++count.asked;
  int expected = sign(scene.exact);
  if (expected == 0) {
    ++count.ties;
    expected = sign(scene.perturbed);
  }
  REQUIRE(expected != 0);
  return expected < 0;
}

template <class Test>
void for_each_scene(std::uint64_t seed, Test test) {
  Rng rng(seed);
  for (const Hardship hardship : fixtures::all_hardships) {
    INFO("hardship: " << fixtures::name_of(hardship));
    for (int i = 0; i < draws; ++i) test(Scene(hardship, rng));
  }
}

}  // namespace

TEST_CASE("beats_at_vertex equals the comparison of exact powers") {
  ClipPredicatesCount count;
  for_each_scene(1, [&](const Scene& s) {
    const bool beats = beats_at_vertex(s.q[0], s.site[0], s.site[1]);
    CHECK(beats != beats_at_vertex(s.q[0], s.site[1], s.site[0]));
    CHECK(beats ==
          expect([&](const auto& x) { return compare_powers(oracle::at(s.q[0]), x[0], x[1]); }, s, count));
  });
  CHECK(count.ties > draws / 10);
}

TEST_CASE("beats_on_edge equals the comparison of exact powers at the exact corner") {
  ClipPredicatesCount count;
  for_each_scene(2, [&](const Scene& s) {
    if (!s.cuts_edge(0, 1)) return;
    const bool beats = beats_on_edge(s.q[0], s.q[1], s.site[0], s.site[1], s.site[2]);
    CHECK(beats == beats_on_edge(s.q[1], s.q[0], s.site[0], s.site[1], s.site[2]));
    // On the bisector the two sites are alike.
    CHECK(beats == beats_on_edge(s.q[0], s.q[1], s.site[1], s.site[0], s.site[2]));
    CHECK(
        beats ==
        expect([&](const auto& x) { return compare_powers(on_edge(s.q[0], s.q[1], x[0], x[1]), x[0], x[2]); },
               s, count));
  });
  CHECK(count.ties > draws / 10);
}

TEST_CASE("beats_in_facet equals the comparison of exact powers at the exact corner") {
  ClipPredicatesCount count;
  for_each_scene(3, [&](const Scene& s) {
    if (!s.has_corner()) return;
    const auto beats = [&](std::size_t owner, std::size_t first, std::size_t second) {
      return beats_in_facet(s.facet(), s.site[owner], s.site[first], s.site[second], s.site[3]);
    };
    const bool answer = beats(0, 1, 2);
    std::array<std::size_t, 3> order{0, 1, 2};
    do CHECK(answer == beats(order[0], order[1], order[2]));
    while (std::ranges::next_permutation(order).found);
    const FacetCorners turned{&s.q[1], &s.q[2], &s.q[0]}, flipped{&s.q[1], &s.q[0], &s.q[2]};
    CHECK(answer == beats_in_facet(turned, s.site[0], s.site[1], s.site[2], s.site[3]));
    CHECK(answer == beats_in_facet(flipped, s.site[0], s.site[1], s.site[2], s.site[3]));
    CHECK(answer == expect(
                        [&](const auto& x) {
                          return compare_powers(in_facet(s.facet(), x[0], x[1], x[2]), x[0], x[3]);
                        },
                        s, count));
  });
  CHECK(count.ties > draws / 10);
}

// Bisectors that pass exactly through a mesh vertex: corners of types B and C fall on the corner of type A,
// and a site that differs from the owner there is judged alike by all three.
TEST_CASE("corners that coincide are judged alike") {
  int on_vertex_b = 0, on_vertex_c = 0;
  for_each_scene(4, [&](const Scene& s) {
    const auto at_vertex = [&](std::size_t i, std::size_t j) {
      return compare_powers(oracle::at(s.q[0]), s.exact[i], s.exact[j]);
    };
    if (at_vertex(0, 1) != 0 || at_vertex(0, 3) == 0) return;
    const bool answer = beats_at_vertex(s.q[0], s.site[0], s.site[3]);
    if (s.cuts_edge(0, 1)) {
      ++on_vertex_b;
      CHECK(answer == beats_on_edge(s.q[0], s.q[1], s.site[0], s.site[1], s.site[3]));
    }
    if (at_vertex(0, 2) == 0 && s.has_corner()) {
      ++on_vertex_c;
      CHECK(answer == beats_in_facet(s.facet(), s.site[0], s.site[1], s.site[2], s.site[3]));
    }
  });
  CHECK(on_vertex_b > 20);
  CHECK(on_vertex_c > 20);
}

// At the C corner of three sites a fourth beats all of them or none; and the owner of the nearest of the four
// C corners is consistent: if j beats 0 at corner (0, 1, 2), then at the corner (0, 1, j), which lies on the
// same bisector, 2 is beaten or beats as the order along that line says.
TEST_CASE("the order of two corners along a bisector does not depend on who asks") {
  int compared = 0;
  for_each_scene(5, [&](const Scene& s) {
    const auto w = [&](std::size_t j, std::size_t k) {
      return in_facet(s.facet(), s.exact[0], s.exact[j], s.exact[k]).w.sign();
    };
    if (w(1, 2) == 0 || w(1, 3) == 0) return;
    ++compared;
    // Along the line f_1 = 0 the functions f_2 and f_3 are affine with slopes of the signs of w(1, 2) and
    // w(1, 3): f_3 at the zero of f_2 and f_2 at the zero of f_3 have opposite signs iff the slopes agree.
    const bool j_at_2 = beats_in_facet(s.facet(), s.site[0], s.site[1], s.site[2], s.site[3]);
    const bool two_at_j = beats_in_facet(s.facet(), s.site[0], s.site[1], s.site[3], s.site[2]);
    CHECK((j_at_2 != two_at_j) == (w(1, 2) == w(1, 3)));
  });
  CHECK(compared > draws);
}
