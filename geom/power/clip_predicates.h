#pragma once
// Exact corner tests of the restricted power diagram (paper, section 4.1: types A, B, C).
//
// For a facet with corners q0, q1, q2, an owner p0 and a site j let F_j[i] = Pi(q_i, j) - Pi(q_i, p0): the
// corner values of an affine function f_j on the facet, negative where j beats p0. The three tests give the
// sign of f_j at
//   A  a mesh vertex q,
//   B  the point of edge (a, b) on the bisector of p0 and j1:
//      sign(F1[b] F2[a] - F1[a] F2[b]) sign(F1[b] - F1[a]),
//   C  the point of the facet on the bisectors of p0 with j1 and j2: with lambda = F1 x F2, D = sum lambda_i,
//      sign(F3 . lambda) sign(D).
// Points have four coordinates, the last one their level (levels.h), which is affine on a facet, too.
// They are exact in the stored doubles, with ties broken by the symbolic perturbation of predicates.h, so
// they always answer. Degrees 2, 4 and 6 in the coordinates. B requires that the (perturbed) f_1 changes sign
// along the edge, C that the two bisectors cross.

#include <array>

#include "geom/exact/predicates.h"

namespace geom {

/// Is the power of mesh vertex q to j less than to owner? Also: which of two sites owns q.
bool beats_at_vertex(const Location3& q, const RankedPoint3& owner, const RankedPoint3& j);

/// Does j beat owner at the point of edge (a, b) that lies on the bisector of owner and on_bisector?
bool beats_on_edge(const Location3& a, const Location3& b, const RankedPoint3& owner,
                   const RankedPoint3& on_bisector, const RankedPoint3& j);

/// The corners of one facet, as the predicates want them.
struct FacetCorners {
  const Vec3 *q0, *q1, *q2;
  std::array<double, 3> levels{};
  Location3 at(std::size_t i) const { return {*(i == 0 ? q0 : i == 1 ? q1 : q2), levels[i]}; }
};

/// Does j beat owner at the point of the facet on the bisectors of owner with first and second?
bool beats_in_facet(const FacetCorners& facet, const RankedPoint3& owner, const RankedPoint3& first,
                    const RankedPoint3& second, const RankedPoint3& j);

}  // namespace geom
