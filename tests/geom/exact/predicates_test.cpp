// The predicates against exact determinants on inputs that are degenerate or nearly so, and their symmetries.

#include "geom/exact/predicates.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "doctest.h"
#include "tests/fixtures/weighted_points.h"
#include "tests/oracle/predicates_oracle.h"

using fixtures::Hardship;
using geom::orient2;
using geom::orient3;
using geom::RankedPoint2;
using geom::RankedPoint3;
using geom::Rng;
using geom::WeightedPoint2;
using geom::WeightedPoint3;
using oracle::ExactSite;

namespace {

constexpr int draws = 1500;  // of each hardship

template <std::size_t N>
std::array<int, N> random_permutation(Rng& rng) {
  std::array<int, N> order;
  std::iota(order.begin(), order.end(), 0);
  rng.shuffle(std::span<int>(order));
  return order;
}

template <std::size_t N>
int parity(const std::array<int, N>& order) {
  int sign = 1;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = i + 1; j < N; ++j)
      if (order[i] > order[j]) sign = -sign;
  return sign;
}

oracle::Scale scale_of(const std::vector<WeightedPoint3>& points) {
  oracle::Scale scale;
  for (const WeightedPoint3& p : points) scale.cover(p);
  return scale;
}

/// N points of space as p[], exactly as x[].
template <std::size_t N>
struct Space {
  std::vector<WeightedPoint3> p;
  std::array<ExactSite, N> x;
  Space(Hardship hardship, Rng& rng) : p(draw(hardship, N, false, rng)) {
    for (std::size_t i = 0; i < N; ++i) x[i] = oracle::exact_site(p[i]);
  }
};
/// The same in the plane.
template <std::size_t N>
struct Plane {
  std::vector<WeightedPoint3> flat;
  std::array<WeightedPoint2, N> p;
  std::array<ExactSite, N> x;
  Plane(Hardship hardship, Rng& rng) : flat(draw(hardship, N, true, rng)) {
    for (std::size_t i = 0; i < N; ++i) {
      p[i] = {flat[i].position.head<2>(), flat[i].weight};
      x[i] = oracle::exact_site(p[i]);
    }
  }
};

/// Runs `test(hardship, rng)` on draws of every hardship.
template <class Test>
void for_each_draw(std::uint64_t seed, Test test) {
  Rng rng(seed);
  for (const Hardship hardship : fixtures::all_hardships) {
    INFO("hardship: " << fixtures::name_of(hardship));
    for (int i = 0; i < draws; ++i) test(hardship, rng);
  }
}

}  // namespace

TEST_CASE("orient2 and power_side2 equal the signs of exact determinants") {
  for_each_draw(1, [](Hardship hardship, Rng& rng) {
    const Plane<4> s(hardship, rng);
    const auto& [a, b, c, e] = s.p;
    CHECK(orient2(a.position, b.position, c.position) == oracle::orient2(s.x[0], s.x[1], s.x[2]));
    CHECK(power_side2(a, b, c, e) == oracle::power_side2(s.x[0], s.x[1], s.x[2], s.x[3]));
  });
}

TEST_CASE("orient3 and power_side3 equal the signs of exact determinants") {
  for_each_draw(2, [](Hardship hardship, Rng& rng) {
    const Space<5> s(hardship, rng);
    CHECK(orient3(s.p[0].position, s.p[1].position, s.p[2].position, s.p[3].position) ==
          oracle::orient3(s.x[0], s.x[1], s.x[2], s.x[3]));
    CHECK(power_side3(s.p[0], s.p[1], s.p[2], s.p[3], s.p[4]) ==
          oracle::power_side3(s.x[0], s.x[1], s.x[2], s.x[3], s.x[4]));
  });
}

TEST_CASE("orientation and power side: odd permutations change the sign") {
  for_each_draw(3, [](Hardship hardship, Rng& rng) {
    const Space<5> s(hardship, rng);
    const auto o = random_permutation<4>(rng);
    const auto p = [&](int i) -> const WeightedPoint3& {
      return s.p[static_cast<std::size_t>(o[std::size_t(i)])];
    };
    CHECK(orient3(p(0).position, p(1).position, p(2).position, p(3).position) ==
          parity(o) * orient3(s.p[0].position, s.p[1].position, s.p[2].position, s.p[3].position));
    CHECK(power_side3(p(0), p(1), p(2), p(3), s.p[4]) ==
          parity(o) * power_side3(s.p[0], s.p[1], s.p[2], s.p[3], s.p[4]));
  });
}

// Ranks of a random order; in the plane, sometimes two points are copies of one site and share a rank.
TEST_CASE("conflicts2 equals the oracle with weights that are perturbed in fact") {
  int ties = 0, unresolved = 0;
  for_each_draw(4, [&](Hardship hardship, Rng& rng) {
    Plane<4> s(hardship, rng);
    const int side = oracle::orient2(s.x[0], s.x[1], s.x[2]);
    if (side == 0) return;
    auto rank = random_permutation<4>(rng);
    if (rng.below(2) == 0) rank[rng.below(4)] = rank[rng.below(4)];
    std::array<RankedPoint2, 4> r;
    for (std::size_t i = 0; i < 4; ++i) r[i] = {&s.p[i], 3 * rank[i]};
    if (side < 0) std::swap(r[0], r[1]);
    const bool conflict = conflicts2(r[0], r[1], r[2], r[3]);
    CHECK(conflict == conflicts2(r[1], r[2], r[0], r[3]));

    int expected = side * oracle::power_side2(s.x[0], s.x[1], s.x[2], s.x[3]);
    if (expected == 0) {
      ++ties;
      const oracle::Scale scale = scale_of(s.flat);
      for (std::size_t i = 0; i < 4; ++i) s.x[i] = lifted(s.x[i], scale.epsilon(rank[i]));
      expected = side * oracle::power_side2(s.x[0], s.x[1], s.x[2], s.x[3]);
      unresolved += expected == 0;
    }
    CHECK(conflict == (expected < 0));
  });
  CHECK(ties > draws);
  CHECK(unresolved > 0);
}

TEST_CASE("conflicts3 equals the oracle with weights that are perturbed in fact") {
  int ties = 0;
  for_each_draw(5, [&](Hardship hardship, Rng& rng) {
    Space<5> s(hardship, rng);
    const int side = oracle::orient3(s.x[0], s.x[1], s.x[2], s.x[3]);
    if (side == 0) return;
    const auto rank = random_permutation<5>(rng);
    std::array<RankedPoint3, 5> r;
    for (std::size_t i = 0; i < 5; ++i) r[i] = {&s.p[i], 7 * rank[i] - 5};
    if (side < 0) std::swap(r[0], r[1]);
    const bool conflict = conflicts3(r[0], r[1], r[2], r[3], r[4]);
    CHECK(conflict == conflicts3(r[1], r[2], r[0], r[3], r[4]));
    CHECK(conflict == conflicts3(r[2], r[3], r[0], r[1], r[4]));

    int expected = side * oracle::power_side3(s.x[0], s.x[1], s.x[2], s.x[3], s.x[4]);
    if (expected == 0) {
      ++ties;
      const oracle::Scale scale = scale_of(s.p);
      for (std::size_t i = 0; i < 5; ++i) s.x[i] = lifted(s.x[i], scale.epsilon(rank[i]));
      expected = side * oracle::power_side3(s.x[0], s.x[1], s.x[2], s.x[3], s.x[4]);
    }
    REQUIRE(expected != 0);
    CHECK(conflict == (expected < 0));
  });
  CHECK(ties > draws);
}

// Two tetrahedra on one facet: e is inside the orthosphere of one iff d is inside that of the other.
TEST_CASE("conflicts3 is mutual across a facet") {
  for_each_draw(6, [](Hardship hardship, Rng& rng) {
    const Space<5> s(hardship, rng);
    const auto rank = random_permutation<5>(rng);
    std::array<RankedPoint3, 5> r;
    for (std::size_t i = 0; i < 5; ++i) r[i] = {&s.p[i], rank[i]};
    const auto side = [&](const RankedPoint3& apex) {
      return orient3(s.p[0].position, s.p[1].position, s.p[2].position, apex.point->position);
    };
    if (side(r[3]) * side(r[4]) >= 0) return;
    const bool up = side(r[3]) > 0;
    const RankedPoint3 &d = r[up ? 3 : 4], &e = r[up ? 4 : 3];
    CHECK(conflicts3(r[0], r[1], r[2], d, e) == conflicts3(r[1], r[0], r[2], e, d));
  });
}
