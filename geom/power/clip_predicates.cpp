#include "geom/power/clip_predicates.h"

#include <initializer_list>

#include "geom/exact/exact_form.h"
#include "geom/exact/exact_vector.h"
#include "geom/power/clip_filters.h"

namespace geom {
namespace {

int sign_of(const filter::Estimate& estimate, const auto& exact) {
  return estimate.certain() ? estimate.sign() : exact().sign();
}

/// Of locations with their levels.
struct ExactDifference {
  ExactVec3 along;
  Expansion level;
  ExactDifference(const Location3& a, const Location3& b)
      : along(exact_difference(a.position, b.position)), level(Expansion::difference(a.level, b.level)) {}
};

/// f_j exactly, as in clip_filters.h: F_j at q0 and, up to a factor 2, the slopes along the given edges.
Expansion exact_slope(const WeightedPoint3& p0, const WeightedPoint3& j, const ExactDifference& edge) {
  const Expansion flat = dot(exact_difference(p0.position, j.position), edge.along);
  return p0.level == j.level ? flat : flat + Expansion::difference(p0.level, j.level) * edge.level;
}
struct ExactRow {
  Expansion f, s, t;
  ExactRow(const Location3& q0, const ExactDifference& u, const ExactDifference& v, const RankedPoint3& p0,
           const RankedPoint3& j)
      : f(form_at(q0, p0, j)),
        s(exact_slope(*p0.point, *j.point, u)),
        t(exact_slope(*p0.point, *j.point, v)) {}
};

/// A coefficient of eps_rank in a perturbed value.
struct Tie {
  std::int32_t rank;
  Expansion coefficient;
};

/// The sign of the sum of eps_rank times coefficient: the smallest rank whose coefficient does not vanish
/// decides.
int sign_of_ties(std::initializer_list<Tie> ties) {
  const Tie* decisive = nullptr;
  for (const Tie& tie : ties)
    if (tie.coefficient.sign() != 0 && (!decisive || tie.rank < decisive->rank)) decisive = &tie;
  return decisive ? decisive->coefficient.sign() : 0;
}

// E = s_1 F_2 - F_1 s_2, F_j at a. Shifts d_1, d_2 of f_1, f_2 change E by d_2 s_1 - d_1 s_2, where d_j =
// eps_0 - eps_j.
int exact_numerator_on_edge(const Location3& a, const Location3& b, const RankedPoint3& owner,
                            const RankedPoint3& on_bisector, const RankedPoint3& j) {
  const ExactDifference u(b, a);
  const Expansion s1 = exact_slope(*owner.point, *on_bisector.point, u);
  const Expansion s2 = exact_slope(*owner.point, *j.point, u);
  const int sign = exact_minor(s1, form_at(a, owner, j), form_at(a, owner, on_bisector), s2).sign();
  if (sign != 0) return sign;
  return sign_of_ties({{owner.rank, s1 - s2}, {on_bisector.rank, s2}, {j.rank, -s1}});
}

// T = det(F, s, t). A shift d_k of f_k adds d_k to F_k, hence d_k times the minor of the other two rows to T.
int exact_numerator_in_facet(const FacetCorners& q, const RankedPoint3& owner, const RankedPoint3& first,
                             const RankedPoint3& second, const RankedPoint3& j) {
  const Location3 q0 = q.at(0);
  const ExactDifference u(q.at(1), q0), v(q.at(2), q0);
  const ExactRow r1(q0, u, v, owner, first), r2(q0, u, v, owner, second), r3(q0, u, v, owner, j);
  const Expansion m12 = exact_minor(r1.s, r2.t, r1.t, r2.s), m23 = exact_minor(r2.s, r3.t, r2.t, r3.s),
                  m31 = exact_minor(r3.s, r1.t, r3.t, r1.s);
  const int sign = (r1.f * m23 + r2.f * m31 + r3.f * m12).sign();
  if (sign != 0) return sign;
  return sign_of_ties(
      {{owner.rank, m12 + m23 + m31}, {first.rank, -m23}, {second.rank, -m31}, {j.rank, -m12}});
}

Expansion exact_denominator_in_facet(const FacetCorners& q, const WeightedPoint3& p0,
                                     const WeightedPoint3& first, const WeightedPoint3& second) {
  const ExactDifference u(q.at(1), q.at(0)), v(q.at(2), q.at(0));
  return exact_minor(exact_slope(p0, first, u), exact_slope(p0, second, v), exact_slope(p0, first, v),
                     exact_slope(p0, second, u));
}

/// A corner test: whether the numerator, which never ties, and the denominator have different signs; each by
/// doubles, by numbers of twice their precision, or exactly.
template <class Filter, class Numerator, class Denominator>
bool differ(Filter filter, Numerator exact_numerator, Denominator exact_denominator) {
  const auto is_decided = [](const filter::Estimate& e) { return e.certain() && e.value != 0; };
  const filter::CornerEstimate quick = filter(double());
  const bool is_quick = is_decided(quick.numerator);
  if (is_quick && quick.denominator.certain()) return quick.numerator.sign() * quick.denominator.sign() < 0;
  const filter::CornerEstimate close = filter(DoubleDouble());
  const int above = is_quick                      ? quick.numerator.sign()
                    : is_decided(close.numerator) ? close.numerator.sign()
                                                  : exact_numerator();
  return above * (close.denominator.certain() ? close.denominator.sign() : exact_denominator()) < 0;
}

/// Two sites at one location: is the power to j less than that to k, anywhere?
bool outweighs(const RankedPoint3& j, const RankedPoint3& k) {
  return j.point->weight != k.point->weight ? j.point->weight > k.point->weight : j.rank < k.rank;
}
bool are_together(const RankedPoint3& j, const RankedPoint3& k) {
  return j.point->position == k.point->position && j.point->level == k.point->level;
}

}  // namespace

// w_j + eps_j lowers f_j by eps_j, w_0 + eps_0 raises it by eps_0: on a tie the smaller rank wins.
bool beats_at_vertex(const Location3& q, const RankedPoint3& owner, const RankedPoint3& j) {
  const int sign =
      sign_of(filter::at_vertex(q, *owner.point, *j.point), [&] { return form_at(q, owner, j); });
  return sign != 0 ? sign < 0 : j.rank < owner.rank;
}

// At the corner the owner's power is that of the sites on whose bisectors it lies.
bool beats_on_edge(const Location3& a, const Location3& b, const RankedPoint3& owner,
                   const RankedPoint3& on_bisector, const RankedPoint3& j) {
  for (const RankedPoint3& known : {owner, on_bisector})
    if (are_together(j, known)) return outweighs(j, known);
  return differ([&]<class Real>(
                    Real) { return filter::on_edge<Real>(a, b, *owner.point, *on_bisector.point, *j.point); },
                [&] { return exact_numerator_on_edge(a, b, owner, on_bisector, j); },
                [&] {
                  return exact_slope(*owner.point, *on_bisector.point, {b, a}).sign();
                });
}

bool beats_in_facet(const FacetCorners& facet, const RankedPoint3& owner, const RankedPoint3& first,
                    const RankedPoint3& second, const RankedPoint3& j) {
  for (const RankedPoint3& known : {owner, first, second})
    if (are_together(j, known)) return outweighs(j, known);
  return differ(
      [&]<class Real>(Real) {
        return filter::in_facet<Real>(facet, *owner.point, *first.point, *second.point, *j.point);
      },
      [&] { return exact_numerator_in_facet(facet, owner, first, second, j); },
      [&] { return exact_denominator_in_facet(facet, *owner.point, *first.point, *second.point).sign(); });
}

}  // namespace geom
