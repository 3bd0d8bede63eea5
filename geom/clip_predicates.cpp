#include "geom/clip_predicates.h"

#include <initializer_list>

#include "geom/exact_form.h"

namespace geom {
namespace {

/// F_j at the three corners of a facet.
struct Form {
  Expansion f[3];
  Form(const FacetCorners& q, const RankedPoint3& owner, const RankedPoint3& j)
      : f{form_at(*q.q0, owner, j), form_at(*q.q1, owner, j), form_at(*q.q2, owner, j)} {}
};

/// Corner values of the intersection of two forms: barycentric coordinates up to scale.
struct Corner {
  Expansion l[3];
  Corner(const Form& a, const Form& b)
      : l{a.f[1] * b.f[2] - a.f[2] * b.f[1], a.f[2] * b.f[0] - a.f[0] * b.f[2],
          a.f[0] * b.f[1] - a.f[1] * b.f[0]} {}
  Expansion sum() const { return l[0] + l[1] + l[2]; }
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

}  // namespace

// w_j + eps_j lowers f_j by eps_j, w_0 + eps_0 raises it by eps_0: on a tie the smaller rank wins.
bool beats_at_vertex(const Vec3& q, const RankedPoint3& owner, const RankedPoint3& j) {
  const int sign = form_at(q, owner, j).sign();
  return sign != 0 ? sign < 0 : j.rank < owner.rank;
}

// E = F1[b] F2[a] - F1[a] F2[b] has the sign of f_2 at the corner times that of F1[b] - F1[a]. Shifts d_1,
// d_2 of the rows F1, F2 change E by d_1 (F2[a] - F2[b]) + d_2 (F1[b] - F1[a]), where d_j = eps_0 - eps_j.
bool beats_on_edge(const Vec3& a, const Vec3& b, const RankedPoint3& owner, const RankedPoint3& on_bisector,
                   const RankedPoint3& j) {
  const Expansion f1a = form_at(a, owner, on_bisector), f1b = form_at(b, owner, on_bisector);
  const Expansion f2a = form_at(a, owner, j), f2b = form_at(b, owner, j);
  const Expansion rise = f1b - f1a;
  int sign = (f1b * f2a - f1a * f2b).sign();
  if (sign == 0) {
    const Expansion fall = f2a - f2b;
    sign = sign_of_ties({{owner.rank, fall + rise}, {on_bisector.rank, -fall}, {j.rank, -rise}});
  }
  return sign * rise.sign() < 0;
}

// T = F3 . (F1 x F2) = det(F1, F2, F3). A shift d of a row adds d times the determinant with that row
// replaced by (1, 1, 1); two shifted rows add nothing more.
bool beats_in_facet(const FacetCorners& facet, const RankedPoint3& owner, const RankedPoint3& first,
                    const RankedPoint3& second, const RankedPoint3& j) {
  const Form f1(facet, owner, first), f2(facet, owner, second), f3(facet, owner, j);
  const Corner corner(f1, f2);
  const Expansion d = corner.sum();
  int sign = (f3.f[0] * corner.l[0] + f3.f[1] * corner.l[1] + f3.f[2] * corner.l[2]).sign();
  if (sign == 0) {
    const Expansion d1 = Corner(f2, f3).sum(), d2 = Corner(f3, f1).sum();  // det(1, F2, F3), det(F1, 1, F3)
    sign = sign_of_ties({{owner.rank, d1 + d2 + d}, {first.rank, -d1}, {second.rank, -d2}, {j.rank, -d}});
  }
  return sign * d.sign() < 0;
}

}  // namespace geom
