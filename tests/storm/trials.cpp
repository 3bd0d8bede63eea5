#include "tests/storm/trials.h"

#include <algorithm>

#include "geom/power/clip_filters.h"
#include "geom/power/construct.h"
#include "geom/regular/apex_search.h"
#include "tests/storm/scene.h"

namespace storm {
namespace {

bool same(const Decision& a, const Decision& b) { return a.sign == b.sign && a.tie == b.tie; }
/// Without perturbation.
int plain(const Decision& d) { return d.tie ? 0 : d.sign; }

Answer ask_orient2(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Scene<3, 0, true> s(kind, range, rng);
  const int sign = orient2(s.x[0], s.x[1], s.x[2]);
  s.expect(geom::orient2(s.flat_at(0), s.flat_at(1), s.flat_at(2)) == sign, "orient2");
  if (rational) {
    const auto exact = s.rational([](const auto& x) { return oracle::orient2(x[0], x[1], x[2]); });
    s.expect(exact.sign == sign, "orient2: the oracles disagree");
  }
  return {true, !geom::filter::orient2(s.flat_at(0), s.flat_at(1), s.flat_at(2)).certain(), sign == 0};
}

Answer ask_orient3(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Scene<4, 0, false> s(kind, range, rng);
  const int sign = orient3(s.x[0], s.x[1], s.x[2], s.x[3]);
  s.expect(geom::orient3(s.at(0), s.at(1), s.at(2), s.at(3)) == sign, "orient3");
  if (rational) {
    const auto exact = s.rational([](const auto& x) { return oracle::orient3(x[0], x[1], x[2], x[3]); });
    s.expect(exact.sign == sign, "orient3: the oracles disagree");
  }
  return {true, !geom::filter::orient3(s.at(0), s.at(1), s.at(2), s.at(3)).certain(), sign == 0};
}

/// conflicts2 too where it may be asked; in half of the draws two points are copies of one site.
Answer ask_power2(const Kind& kind, const Range& range, bool rational, Rng& rng, bool conflicts) {
  Scene<4, 0, true> s(kind, range, rng);
  if (conflicts) {
    const int side = orient2(s.x[0], s.x[1], s.x[2]);
    if (side == 0) return not_asked;
    if (rng.below(2) == 0) {
      s.rank[rng.below(4)] = s.rank[rng.below(4)];
      s.settle();
    }
    if (side < 0) s.swap_first_two();
  }
  const Decision decision = power_side2(s.sites<4>());
  if (rational) {
    const auto exact = s.rational([](const auto& x) { return oracle::power_side2(x[0], x[1], x[2], x[3]); });
    s.expect(same(exact, decision), "power_side2: the oracles disagree");
  }
  if (conflicts) {
    s.expect(
        conflicts2(s.flat_site(0), s.flat_site(1), s.flat_site(2), s.flat_site(3)) == (decision.sign < 0),
        "conflicts2");
  } else {
    s.expect(geom::power_side2(s.flat_p[0], s.flat_p[1], s.flat_p[2], s.flat_p[3]) == plain(decision),
             "power_side2");
  }
  const auto estimate = geom::filter::power_side2(s.flat_p[0], s.flat_p[1], s.flat_p[2], s.flat_p[3]);
  return {true, !estimate.certain(), decision.tie};
}
Answer ask_power_side2(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  return ask_power2(kind, range, rational, rng, false);
}
Answer ask_conflicts2(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  return ask_power2(kind, range, rational, rng, true);
}

/// Five sites, the first four positively oriented.
struct Tetrahedron : Scene<5, 0, false> {
  bool oriented;
  Tetrahedron(const Kind& kind, const Range& range, Rng& rng, bool any_range = false)
      : Scene(kind, range, rng, any_range) {
    const int side = orient3(x[0], x[1], x[2], x[3]);
    oriented = side != 0;
    if (side < 0) swap_first_two();
  }
  Decision power(bool rational) const {
    const Decision decision = power_side3(sites<5>());
    if (!rational) return decision;
    const auto exact =
        this->rational([](const auto& e) { return oracle::power_side3(e[0], e[1], e[2], e[3], e[4]); });
    expect(same(exact, decision), "power_side3: the oracles disagree");
    return decision;
  }
  Answer answer(const Decision& decision) const {
    return {true, !geom::filter::power_side3(p[0], p[1], p[2], p[3], p[4]).certain(), decision.tie};
  }
};

Answer ask_power_side3(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Tetrahedron s(kind, range, rng);
  const Decision decision = s.power(rational);
  s.expect(geom::power_side3(s.p[0], s.p[1], s.p[2], s.p[3], s.p[4]) == plain(decision), "power_side3");
  return s.answer(decision);
}

Answer ask_conflicts3(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Tetrahedron s(kind, range, rng);
  if (!s.oriented) return not_asked;
  const Decision decision = s.power(rational);
  s.expect(conflicts3(s.site(0), s.site(1), s.site(2), s.site(3), s.site(4)) == (decision.sign < 0),
           "conflicts3");
  return s.answer(decision);
}

/// Whatever the filter is certain of is so.
template <class Real>
Answer ask_pencil(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Tetrahedron s(kind, range, rng, true);
  if (!s.oriented) return not_asked;
  const geom::Pencil<Real> pencil(s.p[0], s.p[1], s.p[2]);
  const auto d = pencil.place(s.p[3]), e = pencil.place(s.p[4]);
  const int side = pencil.side(e), power = pencil.power_side(d, e);
  s.expect(pencil.side(d) >= 0, "pencil: side of d");
  s.expect(side == 0 || side == orient3(s.x[0], s.x[1], s.x[2], s.x[4]), "pencil: side of e");
  const Decision decision = s.power(rational);
  s.expect(power == 0 || power == plain(decision), "pencil: power side");
  return {true, side == 0 || power == 0, decision.tie};
}

/// Does a second candidate come before the first?
Answer ask_apex_search(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Tetrahedron s(kind, range, rng);
  if (!s.oriented) return not_asked;
  geom::ApexSearch search(s.site(0), s.site(1), s.site(2));
  s.expect(search.offer(s.site(3)), "apex search: the first candidate is refused");
  const Decision decision = s.power(rational);
  const bool above = orient3(s.x[0], s.x[1], s.x[2], s.x[4]) > 0;
  s.expect(search.offer(s.site(4)) == (above && decision.sign < 0), "apex search");
  const geom::Pencil<double> pencil(s.p[0], s.p[1], s.p[2]);
  const auto d = pencil.place(s.p[3]), e = pencil.place(s.p[4]);
  return {true, pencil.side(e) == 0 || pencil.power_side(d, e) == 0, decision.tie};
}

Answer ask_at_vertex(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Scene<2, 1, false> s(kind, range, rng);
  const Decision decision = at_vertex(s.x[2], s.sites<2>());
  s.expect(beats_at_vertex(s.at(2), s.site(0), s.site(1)) == (decision.sign < 0), "beats_at_vertex");
  if (rational) {
    const auto exact =
        s.rational([&](const auto& x) { return compare_powers(oracle::at(s.at(2)), x[0], x[1]); });
    s.expect(same(exact, decision), "beats_at_vertex: the oracles disagree");
  }
  return {true, !geom::filter::at_vertex(s.at(2), s.p[0], s.p[1]).certain(), decision.tie};
}

bool certain(const geom::filter::CornerEstimate& e) {
  return e.numerator.certain() && e.denominator.certain();
}

Answer ask_on_edge(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Scene<3, 2, false> s(kind, range, rng);
  if (at_vertex(s.x[3], s.sites<2>()).sign * at_vertex(s.x[4], s.sites<2>()).sign >= 0) return not_asked;
  const Decision decision = on_edge(s.x[3], s.x[4], s.sites<3>());
  s.expect(beats_on_edge(s.at(3), s.at(4), s.site(0), s.site(1), s.site(2)) == (decision.sign < 0),
           "beats_on_edge");
  if (rational) {
    const auto exact = s.rational([&](const auto& x) {
      return compare_powers(oracle::on_edge(s.at(3), s.at(4), x[0], x[1]), x[0], x[2]);
    });
    s.expect(same(exact, decision), "beats_on_edge: the oracles disagree");
  }
  return {true, !certain(geom::filter::on_edge(s.at(3), s.at(4), s.p[0], s.p[1], s.p[2])), decision.tie};
}

Answer ask_in_facet(const Kind& kind, const Range& range, bool rational, Rng& rng) {
  const Scene<4, 3, false> s(kind, range, rng);
  const Decision decision = in_facet(std::span<const WideSite>(s.x).last<3>(), s.sites<4>());
  if (decision.sign == 0) return not_asked;
  s.expect(beats_in_facet(s.facet(), s.site(0), s.site(1), s.site(2), s.site(3)) == (decision.sign < 0),
           "beats_in_facet");
  if (rational) {
    const auto exact = s.rational([&](const auto& x) {
      return compare_powers(oracle::in_facet(s.facet(), x[0], x[1], x[2]), x[0], x[3]);
    });
    s.expect(same(exact, decision), "beats_in_facet: the oracles disagree");
  }
  return {true, !certain(geom::filter::in_facet(s.facet(), s.p[0], s.p[1], s.p[2], s.p[3])), decision.tie};
}

/// The filter that clip.h tries first (construct.h): a value beyond its error has the right sign.
Answer ask_bisector(const Kind& kind, const Range& range, bool, Rng& rng) {
  const Scene<2, 1, false> s(kind, range, rng);
  double extent = 0;
  for (const WeightedPoint3& q : s.p) extent = std::max(extent, q.position.lpNorm<Eigen::Infinity>());
  const geom::Bisector b = geom::bisector(s.p[0], s.p[1], extent);
  const double f = b(s.at(2));
  const bool sure = std::abs(f) > b.error;
  const Decision decision = at_vertex(s.x[2], s.sites<2>());
  s.expect(!sure || plain(decision) == (f > 0) - (f < 0), "bisector");
  return {true, !sure, decision.tie};
}

constexpr Predicate all_predicates[] = {
    {"orient2", 2, ask_orient2},
    {"orient3", 3, ask_orient3},
    {"power_side2", 4, ask_power_side2},
    {"power_side3", 5, ask_power_side3},
    {"conflicts2", 4, ask_conflicts2},
    {"conflicts3", 5, ask_conflicts3},
    {"beats_at_vertex", 2, ask_at_vertex},
    {"beats_on_edge", 4, ask_on_edge},
    {"beats_in_facet", 6, ask_in_facet},
    {"apex_search", 5, ask_apex_search},
    {"pencil", 6, ask_pencil<double>},
    {"pencil_twofold", 6, ask_pencil<geom::DoubleDouble>},
    {"bisector", 2, ask_bisector},
    {"rounded_edge", 6, ask_rounded_on_edge},
    {"rounded_facet", 6, ask_rounded_in_facet},
};

}  // namespace

std::span<const Predicate> predicates() { return all_predicates; }

Tally& Tally::operator+=(const Tally& other) {
  calls += other.calls, unsure += other.unsure, ties += other.ties;
  return *this;
}

Tally run(const Predicate& predicate, const Kind& kind, const Run& run) {
  Rng rng(run.seed);
  Tally tally;
  for (std::uint64_t draws = 0; draws < 20 * run.count && tally.calls < run.count; ++draws) {
    const bool rational = run.rational_every != 0 && draws % run.rational_every == 0;
    const Answer answer = predicate.ask(kind, predicate.range(), rational, rng);
    tally.calls += answer.asked, tally.unsure += answer.unsure, tally.ties += answer.tie;
  }
  return tally;
}

}  // namespace storm
