#pragma once
// What a predicate is asked about.

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include "tests/oracle/predicates_oracle.h"
#include "tests/storm/trials.h"
#include "tests/storm/wide_oracle.h"

namespace storm {

using geom::RankedPoint2;
using geom::RankedPoint3;
using geom::Rng;
using geom::Vec2;
using geom::Vec3;
using geom::WeightedPoint2;
using geom::WeightedPoint3;

/// N sites, of distinct random ranks, and the corners of a facet.
template <std::size_t N, std::size_t C, bool flat>
struct Scene {
  std::array<WeightedPoint3, N + C> p;
  std::array<WeightedPoint2, N> flat_p;
  std::array<WideSite, N + C> x;
  std::array<int, N> rank;

  Scene(const Kind& kind, const Range& range, Rng& rng, bool any_range = false) {
    kind.draw(p, {C, flat, range}, rng);
    if (any_range && rng.below(2) == 0) rescale(static_cast<int>(rng.below(1000)) - 680);
    std::iota(rank.begin(), rank.end(), 0);
    rng.shuffle(std::span<int>(rank));
    settle();
  }

  /// After p or rank have changed.
  void settle() {
    const long unit = common_unit(p);
    for (std::size_t i = 0; i < N + C; ++i) x[i] = WideSite(p[i], unit, i < N ? rank[i] : 0);
    for (std::size_t i = 0; i < N; ++i) flat_p[i] = {p[i].position.template head<2>(), p[i].weight};
  }
  void swap_first_two() {
    std::swap(p[0], p[1]);
    std::swap(flat_p[0], flat_p[1]);
    std::swap(x[0].x, x[1].x), std::swap(x[0].y, x[1].y), std::swap(x[0].z, x[1].z);
    std::swap(x[0].weight, x[1].weight);
  }

  const Vec3& at(std::size_t i) const { return p[i].position; }
  const Vec2& flat_at(std::size_t i) const { return flat_p[i].position; }
  RankedPoint3 site(std::size_t i) const { return {&p[i], 3 * rank[i] - 4}; }
  RankedPoint2 flat_site(std::size_t i) const { return {&flat_p[i], 3 * rank[i] - 4}; }
  geom::FacetCorners facet() const { return {&p[N].position, &p[N + 1].position, &p[N + 2].position}; }
  template <std::size_t M>
  std::span<const WideSite, M> sites() const {
    return std::span<const WideSite>(x).template first<M>();
  }

  /// `sign` of the sites in rational numbers, or on a tie of those whose weights are perturbed in fact.
  template <class Sign>
  Decision rational(const Sign& sign) const {
    std::array<oracle::ExactSite, N> exact;
    for (std::size_t i = 0; i < N; ++i) exact[i] = oracle::exact_site(p[i]);
    if (const int s = sign(exact); s != 0) return {s, false};
    oracle::Scale scale;
    for (const WeightedPoint3& q : p) scale.cover(q);
    for (std::size_t i = 0; i < N; ++i) exact[i] = lifted(exact[i], scale.epsilon(rank[i]));
    return {sign(exact), true};
  }

  void expect(bool right, const char* what) const {
    if (right) return;
    std::string text = what;
    for (std::size_t i = 0; i < N + C; ++i) {
      char line[200];
      std::snprintf(line, sizeof line, "\n  %a %a %a  weight %a  rank %d", p[i].position.x(),
                    p[i].position.y(), p[i].position.z(), p[i].weight, i < N ? rank[i] : -1);
      text += line;
    }
    throw Fault{text};
  }

 private:
  void rescale(int exponent) {
    for (WeightedPoint3& q : p) {
      for (double& c : q.position) c = std::ldexp(c, exponent);
      q.weight = std::ldexp(q.weight, 2 * exponent);
    }
  }
};

constexpr Answer not_asked{false, false, false};

/// rounded.cpp: the rounded corners of construct.h, whose tolerances clip.h believes.
Answer ask_rounded_on_edge(const Kind& kind, const Range& range, bool rational, Rng& rng);
Answer ask_rounded_in_facet(const Kind& kind, const Range& range, bool rational, Rng& rng);

}  // namespace storm
